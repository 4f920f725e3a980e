// Writes the test volumes with OpenVDB 10.0: see README.md.
#include <openvdb/openvdb.h>
#include <openvdb/io/Stream.h>
#include <fstream>
using namespace openvdb;

// Exact in half precision: eighths from 1/8 to 4.
static double ramp(int x, int y, int z) { return (((x * 7 + y * 3 + z * 5) % 32 + 32) % 32) / 8.0 + 0.125; }

template <class Grid, class F> typename Grid::Ptr box(const char *name, typename Grid::ValueType background, F value) {
    auto grid = Grid::create(background);
    grid->setName(name);
    auto a = grid->getAccessor();
    for (int x = -4; x < 12; ++x) for (int y = 0; y < 10; ++y) for (int z = 3; z < 8; ++z)
        a.setValue(Coord(x, y, z), value(x, y, z));
    return grid;
}
static FloatGrid::Ptr tiles() {
    auto grid = box<FloatGrid>("density", 0.0f, [](int x, int y, int z) { return float(ramp(x, y, z)); });
    grid->tree().addTile(1, Coord(64, 64, 64), 2.5f, true);
    grid->tree().addTile(1, Coord(0, 0, 64), 9.0f, false);
    grid->tree().addTile(2, Coord(128, 0, 0), 3.5f, true);
    grid->tree().addTile(3, Coord(-8192, 4096, 0), 7.0f, true);
    grid->tree().addTile(3, Coord(4096, 0, 0), -1.0f, false);
    grid->setGridClass(GRID_FOG_VOLUME);
    auto map = math::MapBase::Ptr(new math::ScaleTranslateMap(Vec3d(0.5, 0.25, 2), Vec3d(1, 2, 3)));
    grid->setTransform(math::Transform::Ptr(new math::Transform(map)));
    return grid;
}
// Leaf k at x = 8 k has k + 1 active voxels; its inactive ones ask for the k-th way to store masks.
static FloatGrid::Ptr kinds() {
    auto grid = FloatGrid::create(3.0f);
    grid->setName("kinds");
    grid->setGridClass(GRID_LEVEL_SET);
    const float values[7][3] = {{3, 3, 3}, {-3, -3, -3}, {5, 5, 5}, {3, -3, 3}, {3, 5, 3}, {5, 6, 5}, {5, 6, 7}};
    for (int k = 0; k < 7; ++k) {
        auto *leaf = grid->tree().touchLeaf(Coord(8 * k, 0, 0));
        for (int i = 0; i < 512; ++i) leaf->setValueOff(i, values[k][i % 3]);
        for (int i = 0; i <= k; ++i) leaf->setValueOn(i * 37, 0.5f * i - 1);
    }
    return grid;
}
template <class V> static V vec(int x, int y, int z) { double r = ramp(x, y, z) * 8; return V(r, -r, x); }
static void file(const char *name, uint32_t compression, GridPtrVec grids) {
    io::File f(name);
    f.setCompression(compression);
    f.write(grids);
    f.close();
}
int main() {
    initialize();
    const uint32_t MASK = io::COMPRESS_ACTIVE_MASK, BLOSC = io::COMPRESS_BLOSC;
    file("tiles_blosc.vdb", BLOSC | MASK, {tiles()});
    auto half = tiles(); half->setSaveFloatAsHalf(true);
    file("tiles_half_masks.vdb", MASK, {half});
    file("kinds_masks.vdb", MASK, {kinds()});
    file("kinds_plain.vdb", io::COMPRESS_NONE, {kinds()});
    auto kinds_half = kinds(); kinds_half->setSaveFloatAsHalf(true);
    file("kinds_half_blosc.vdb", BLOSC | MASK, {kinds_half});
    auto v3h = box<Vec3SGrid>("half", Vec3s(0), vec<Vec3s>); v3h->setSaveFloatAsHalf(true);
    v3h->setVectorType(VEC_CONTRAVARIANT_RELATIVE); v3h->setGridClass(GRID_STAGGERED);
    file("vectors_blosc.vdb", BLOSC | MASK, {v3h, box<Vec3SGrid>("single", Vec3s(1, 2, 3), vec<Vec3s>),
        box<Vec3DGrid>("double", Vec3d(0), vec<Vec3d>), box<Vec3IGrid>("int", Vec3i(0), vec<Vec3i>)});
    auto eighths = [](int x, int y, int z) { return int(ramp(x, y, z) * 8); };
    auto odd = box<BoolGrid>("bool", false, [&](int x, int y, int z) { return eighths(x, y, z) % 2 == 1; });
    odd->tree().addTile(2, Coord(128, 0, 0), true, true);
    auto dh = box<DoubleGrid>("double half", 0.0, ramp); dh->setSaveFloatAsHalf(true);
    file("numbers_masks.vdb", MASK, {box<DoubleGrid>("double", 0.0, ramp), dh,
        box<Int32Grid>("int32", 0, eighths), box<Int64Grid>("int64", 0, eighths), odd});
    // Others between grids that are read: a mask, points' indices, a frustum.
    auto mask = MaskGrid::create(); mask->setName("mask"); mask->tree().setValueOn(Coord(1, 2, 3));
    auto one = [](const char *name, math::MapBase *map) {
        auto grid = FloatGrid::create(); grid->setName(name); grid->tree().setValue(Coord(1, 2, 3), 4);
        grid->setTransform(math::Transform::Ptr(new math::Transform(math::MapBase::Ptr(map))));
        return grid;
    };
    math::Mat4d m(0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1);
    file("maps_blosc.vdb", BLOSC | MASK, {one("affine", new math::AffineMap(m)), mask,
        one("unitary", new math::UnitaryMap(Vec3d(0, 0, 1), M_PI / 2)),
        one("frustum", new math::NonlinearFrustumMap(BBoxd(Vec3d(0), Vec3d(10)), 0.5, 2)),
        one("moved", new math::TranslationMap(Vec3d(1, 2, 3))), one("scaled", new math::ScaleMap(Vec3d(2, 3, 4))),
        one("even", new math::UniformScaleMap(2)),
        one("even moved", new math::UniformScaleTranslateMap(2, Vec3d(1, 2, 3)))});
    auto first = box<FloatGrid>("same", 0.0f, ramp);
    auto shared = first->copy(); // shallow: the tree is shared
    shared->setTransform(math::Transform::createLinearTransform(2));
    auto third = FloatGrid::create(1); third->setName("same");
    file("instances_blosc.vdb", BLOSC | MASK, {first, shared, third});
    std::ofstream out("stream_masks.vdb", std::ios::binary);
    io::Stream stream(out); stream.setCompression(MASK);
    MetaMap meta; meta.insertMeta("creator", StringMetadata("npr-vdb"));
    meta.insertMeta("when", Vec4SMetadata(Vec4s(1, 2, 3, 4)));
    stream.write({first, shared, box<Vec3SGrid>("velocity", Vec3s(0), vec<Vec3s>)}, meta);
    file("empty_blosc.vdb", BLOSC | MASK, {FloatGrid::create(0)});
    file("no_grids.vdb", BLOSC | MASK, {});
}
