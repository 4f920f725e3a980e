// Writes three_poses.json: where three.js has the nodes and some vertices of models at 20 times of each of their clips.
//
//     npm install three@0.187
//     node three_poses.mjs FOLDER_OF_MODELS > three_poses.json
//
// Nothing is drawn, so materials and images are taken out before a file is read. Numbers are places in the world, as
// whole steps of a 20000th of the model's size; but for the first of a clip, as differences from the moment before.

import fs from 'node:fs';
import path from 'node:path';
import { AnimationMixer, Box3, LoopOnce, Vector3, REVISION } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

globalThis.self = globalThis;

const MODELS = [
  'robot_animated.glb', 'fox.glb', 'rigged_figure.glb', 'animated_morph_cube.glb', 'morph_stress_test.glb',
];
const TIMES = 20;
const VERTICES = 2;
const STEPS = 20000;

/** The file without materials and images. */
function bare(file) {
  const jsonBytes = file.readUInt32LE(12);
  const json = JSON.parse(file.subarray(20, 20 + jsonBytes).toString());
  for (const key of ['materials', 'textures', 'images', 'samplers']) delete json[key];
  for (const mesh of json.meshes) for (const primitive of mesh.primitives) delete primitive.material;
  let text = Buffer.from(JSON.stringify(json));
  text = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, ' ')]);
  const rest = file.subarray(20 + jsonBytes);
  const head = Buffer.from(file.subarray(0, 20));
  head.writeUInt32LE(20 + text.length + rest.length, 8);
  head.writeUInt32LE(text.length, 12);
  const whole = Buffer.concat([head, text, rest]);
  return whole.buffer.slice(whole.byteOffset, whole.byteOffset + whole.length);
}

/** Nodes of the file in the order in which its tree is walked, and the surfaces on them. */
function parts(gltf) {
  const known = gltf.parser.associations;
  const nodes = [];
  const surfaces = [];
  gltf.scene.traverse((object) => {
    if (known.get(object)?.nodes !== undefined) nodes.push(object);
    if (object.isMesh) surfaces.push(object);
  });
  return { nodes, surfaces };
}

function places({ nodes, surfaces }) {
  const all = nodes.map((node) => new Vector3().setFromMatrixPosition(node.matrixWorld));
  for (const surface of surfaces) {
    const count = surface.geometry.attributes.position.count;
    for (let k = 0; k < VERTICES; k++) {
      const vertex = Math.floor(((k + 0.5) * count) / VERTICES);
      all.push(surface.getVertexPosition(vertex, new Vector3()).applyMatrix4(surface.matrixWorld));
    }
  }
  return all;
}

async function model(folder, name) {
  const gltf = await new GLTFLoader().parseAsync(bare(fs.readFileSync(path.join(folder, name))), '');
  const found = parts(gltf);
  gltf.scene.updateMatrixWorld(true);
  const size = new Box3().setFromObject(gltf.scene, true).getSize(new Vector3()).length();
  const step = size / STEPS;
  const clips = [];
  for (const clip of gltf.animations) {
    const mixer = new AnimationMixer(gltf.scene);
    const action = mixer.clipAction(clip);
    action.setLoop(LoopOnce);
    action.clampWhenFinished = true;
    action.play();
    const moments = [];
    let before = [];
    for (let k = 0; k < TIMES; k++) {
      // Thirds keep the times off the keys.
      const time = Math.round(((k + 1 / 3) / TIMES) * clip.duration * 1000) / 1000;
      mixer.setTime(time);
      gltf.scene.updateMatrixWorld(true);
      const numbers = places(found).flatMap((place) => place.toArray().map((v) => Math.round(v / step)));
      moments.push({ time, places: numbers.map((number, index) => number - (before[index] ?? 0)) });
      before = numbers;
    }
    mixer.stopAllAction();
    mixer.uncacheRoot(gltf.scene);
    clips.push({ duration: clip.duration, moments });
  }
  return { name, size, nodes: found.nodes.length, surfaces: found.surfaces.length, clips };
}

/** JSON of short lines. */
function short(text) {
  return text.replace(/(.{1,110}[,{[])/g, '$1\n');
}

const all = [];
for (const name of MODELS) all.push(await model(process.argv[2], name));
const head = { three: REVISION, steps: STEPS, vertices: VERTICES, models: all };
process.stdout.write(short(JSON.stringify(head)) + '\n');
