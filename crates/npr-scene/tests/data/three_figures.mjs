// Writes three_figures.json: where three-vrm has the bones of avatars in poses and in a motion, and how it weights morphs
// under expressions.
//
//     npm install three@0.187 @pixiv/three-vrm-core@3.5.5 @pixiv/three-vrm-animation@3.5.5
//     node three_figures.mjs FOLDER_OF_MODELS ../../../../assets/poses gesture.vrma > three_figures.json
//
// Nothing is drawn, so materials and images are taken out before a file is read. Places of bones are those of the world,
// as whole steps of a 20000th of the model's size; avatars of VRM 0.x are turned to look along +Z, as those of 1.0 do.

import fs from 'node:fs';
import path from 'node:path';
import { AnimationMixer, Box3, LoopOnce, REVISION, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { VRMCoreLoaderPlugin } from '@pixiv/three-vrm-core';
import {
  VRMAnimationLoaderPlugin, VRMLookAtQuaternionProxy, createVRMAnimationClip,
} from '@pixiv/three-vrm-animation';

globalThis.self = globalThis;
console.warn = () => {};

const MODELS = ['godette_vrm0.vrm', 'godette_vrm1.vrm', 'debug_robot_vrm1.vrm'];
const POSES = ['standing', 'waving', 'walking'];
const SHARES = [0.3, 0.5, 1];
const TIMES = [0, 0.45, 1.2, 1.9];
const STEPS = 20000;

/** The file without materials and images. */
function bare(file) {
  const jsonBytes = file.readUInt32LE(12);
  const json = JSON.parse(file.subarray(20, 20 + jsonBytes).toString());
  for (const key of ['materials', 'textures', 'images', 'samplers']) delete json[key];
  for (const mesh of json.meshes ?? []) for (const primitive of mesh.primitives) delete primitive.material;
  delete json.extensions?.VRM?.meta?.texture;
  delete json.extensions?.VRM?.materialProperties;
  delete json.extensions?.VRMC_vrm?.meta?.thumbnailImage;
  let text = Buffer.from(JSON.stringify(json));
  text = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, ' ')]);
  const rest = file.subarray(20 + jsonBytes);
  const head = Buffer.from(file.subarray(0, 20));
  head.writeUInt32LE(20 + text.length + rest.length, 8);
  head.writeUInt32LE(text.length, 12);
  const whole = Buffer.concat([head, text, rest]);
  return whole.buffer.slice(whole.byteOffset, whole.byteOffset + whole.length);
}

function loader() {
  const made = new GLTFLoader();
  made.register((parser) => new VRMCoreLoaderPlugin(parser));
  made.register((parser) => new VRMAnimationLoaderPlugin(parser));
  return made;
}

async function avatar(folder, name) {
  const gltf = await loader().parseAsync(bare(fs.readFileSync(path.join(folder, name))), '');
  const vrm = gltf.userData.vrmCore;
  if (vrm.meta.metaVersion === '0') vrm.scene.rotation.y = Math.PI;
  return { gltf, vrm };
}

/** A pose of VRM 1.0 for an avatar, which may look the other way. */
function turned(pose, vrm) {
  const over = vrm.meta.metaVersion === '0' ? -1 : 1;
  const turn = (list) => list && list.map((v, i) => (i === 0 || i === 2 ? v * over : v));
  const bones = Object.entries(pose);
  return Object.fromEntries(bones.map(([bone, { position, rotation }]) => [
    bone, { position: turn(position), rotation: turn(rotation) },
  ]));
}

function places(vrm, step) {
  vrm.scene.updateMatrixWorld(true);
  return Object.fromEntries(Object.entries(vrm.humanoid.rawHumanBones).sort().map(([name, { node }]) => [
    name, new Vector3().setFromMatrixPosition(node.matrixWorld).toArray().map((v) => Math.round(v / step)),
  ]));
}

/** The weights of all nodes with morphs, by the number of the node in the file. */
function weights({ gltf, vrm }) {
  const found = {};
  vrm.scene.traverse((object) => {
    const node = gltf.parser.associations.get(object)?.nodes
      ?? gltf.parser.associations.get(object.parent)?.nodes;
    if (object.isMesh && object.morphTargetInfluences && found[node] === undefined) {
      found[node] = object.morphTargetInfluences.map((v) => Math.round(v * 1e6) / 1e6);
    }
  });
  return found;
}

async function model(folder, poses, motion, name) {
  const { vrm, gltf } = await avatar(folder, name);
  vrm.scene.updateMatrixWorld(true);
  const size = new Box3().setFromObject(vrm.scene, true).getSize(new Vector3()).length();
  const step = size / STEPS;
  const told = { name, size, rest: places(vrm, step), poses: [], expressions: [], moments: [] };

  for (const pose of POSES) {
    const said = JSON.parse(fs.readFileSync(path.join(poses, `${pose}.json`))).pose;
    vrm.humanoid.resetNormalizedPose();
    vrm.humanoid.setNormalizedPose(turned(said, vrm));
    vrm.humanoid.update();
    told.poses.push({ pose, places: places(vrm, step) });
  }
  vrm.humanoid.resetNormalizedPose();

  const faces = vrm.expressionManager;
  for (const expression of faces.expressions.map((face) => face.expressionName).sort()) {
    for (const share of SHARES) {
      faces.resetValues();
      faces.setValue(expression, share);
      faces.update();
      told.expressions.push({ expression, share, weights: weights({ gltf, vrm }) });
    }
  }
  faces.resetValues();

  const file = await loader().parseAsync(bare(fs.readFileSync(motion)), '');
  const proxy = new VRMLookAtQuaternionProxy(vrm.lookAt);
  proxy.name = 'look';
  vrm.scene.add(proxy);
  const clip = createVRMAnimationClip(file.userData.vrmAnimations[0], vrm);
  // Looks are left out.
  clip.tracks = clip.tracks.filter((track) => !track.name.startsWith('look'));
  const mixer = new AnimationMixer(vrm.scene);
  const action = mixer.clipAction(clip);
  action.setLoop(LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  for (const time of TIMES) {
    mixer.setTime(time);
    vrm.humanoid.update();
    faces.update();
    told.moments.push({ time, places: places(vrm, step), weights: weights({ gltf, vrm }) });
  }
  return told;
}

/** JSON of short lines. */
function short(text) {
  return text.replace(/(.{1,110}[,{[])/g, '$1\n');
}

const [folder, poses, motion] = process.argv.slice(2);
const all = [];
for (const name of MODELS) all.push(await model(folder, poses, motion, name));
process.stdout.write(`${short(JSON.stringify({ three: REVISION, steps: STEPS, models: all }))}\n`);
