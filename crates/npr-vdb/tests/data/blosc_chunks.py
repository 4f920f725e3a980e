# Writes blosc_chunks.bin with numcodecs 0.16 (c-blosc 1.21): one container after another.
from numcodecs import blosc

def data(length):
    return bytes((k // 300 * (k % 4) + k // 17 % 3) & 255 for k in range(length))

def noise(length):
    state, out = 1, bytearray()
    for _ in range(length):
        state = (state * 1103515245 + 12345) & 0x7FFFFFFF
        out.append(state >> 16 & 255)
    return bytes(out)

with open("blosc_chunks.bin", "wb") as out:
    for codec in [b"blosclz", b"lz4", b"lz4hc", b"zlib", b"zstd"]:
        for shuffle in [0, 1, 2]:
            for typesize, length, blocksize in [(4, 1024, 0), (8, 2055, 1024), (2, 600, 0), (1, 300, 0), (3, 1000, 0)]:
                c = blosc.compress(data(length), codec, 9, shuffle, blocksize, typesize)
                assert blosc.decompress(c) == data(length)
                out.write(c)
    # A long gap between repeats, for BloscLZ's far distances; and bytes that nothing makes smaller.
    far = noise(9000)
    out.write(blosc.compress(far + far[:500], b"blosclz", 9, 0, 16384, 1))
    out.write(blosc.compress(noise(200), b"lz4", 9, 1, 0, 4))
