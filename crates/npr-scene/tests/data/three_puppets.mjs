// Writes three_puppets.json: how three-vrm lets figures look somewhere, follow constraints, and swing.
//
//     npm install three@0.187 @pixiv/three-vrm-core@3.5.5 @pixiv/three-vrm-animation@3.5.5 \
//         @pixiv/three-vrm-node-constraint@3.5.5 @pixiv/three-vrm-springbone@3.5.5
//     node three_puppets.mjs FOLDER_OF_MODELS puppet.vrm gesture.vrma > three_puppets.json
//
// Nothing is drawn, so materials and images are taken out before a file is read. Avatars of VRM 0.x are turned to look
// along +Z, as those of 1.0 do. Curves of VRM 0.x, which three-vrm passes over, are made straight. Against VRM 1.0 it
// takes the range of one for the other where bones of eyes go up or down, so both are exchanged before.

import fs from 'node:fs';
import path from 'node:path';
import { AnimationMixer, LoopOnce, Object3D, Quaternion, REVISION, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { VRMCoreLoaderPlugin } from '@pixiv/three-vrm-core';
import {
  VRMAnimationLoaderPlugin, VRMLookAtQuaternionProxy, createVRMAnimationClip,
} from '@pixiv/three-vrm-animation';
import { VRMNodeConstraintLoaderPlugin } from '@pixiv/three-vrm-node-constraint';
import { VRMSpringBoneLoaderPlugin } from '@pixiv/three-vrm-springbone';

globalThis.self = globalThis;
console.warn = () => {};

const TARGETS = [[0, 1.3, 5], [2, 1, 1], [-3, 2.5, 2], [0.5, 0, 1], [-0.4, 3, -0.3], [0.3, 1.2, -4]];
const STEPS = 120;
const SEEN = [0, 1, 2, 10, 30, 60, 90, 120];

/** The file without materials and images. */
function bare(file) {
  const jsonBytes = file.readUInt32LE(12);
  const json = JSON.parse(file.subarray(20, 20 + jsonBytes).toString());
  for (const key of ['materials', 'textures', 'images', 'samplers']) delete json[key];
  for (const mesh of json.meshes ?? []) for (const primitive of mesh.primitives) delete primitive.material;
  delete json.extensions?.VRM?.meta?.texture;
  delete json.extensions?.VRM?.materialProperties;
  delete json.extensions?.VRMC_vrm?.meta?.thumbnailImage;
  for (const map of Object.values(json.extensions?.VRM?.firstPerson ?? {})) {
    if (map.curve) map.curve = [0, 0, 0, 1, 1, 1, 1, 0];
  }
  const look = json.extensions?.VRMC_vrm?.lookAt;
  if (look?.type === 'bone') {
    [look.rangeMapVerticalUp, look.rangeMapVerticalDown] = [look.rangeMapVerticalDown, look.rangeMapVerticalUp];
  }
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
  for (const Plugin of [
    VRMCoreLoaderPlugin, VRMAnimationLoaderPlugin, VRMNodeConstraintLoaderPlugin, VRMSpringBoneLoaderPlugin,
  ]) made.register((parser) => new Plugin(parser));
  return made;
}

async function avatar(file) {
  const gltf = await loader().parseAsync(bare(fs.readFileSync(file)), '');
  const vrm = gltf.userData.vrmCore;
  if (vrm.meta.metaVersion === '0') vrm.scene.rotation.y = Math.PI;
  vrm.scene.updateMatrixWorld(true);
  const nodes = await gltf.parser.getDependencies('node');
  const names = gltf.parser.json.nodes.map((node) => node.name);
  const { vrmNodeConstraintManager: constraints, vrmSpringBoneManager: springs } = gltf.userData;
  return { vrm, nodes, names, constraints, springs };
}

const rounded = (v) => Math.round(v * 1e5) / 1e5;

function place(node) {
  return new Vector3().setFromMatrixPosition(node.matrixWorld).toArray().map(rounded);
}

/** Turns of the eyes beside their parents, and values of the expressions that look. */
function looks({ vrm }) {
  const head = vrm.humanoid.getRawBoneNode('head');
  return [0, 1].flatMap((bent) => {
    if (bent) {
      head.quaternion.multiply(new Quaternion(0.1, -0.2, 0.05, 0.9).normalize());
      vrm.scene.updateMatrixWorld(true);
    }
    return TARGETS.map((target) => {
      const at = new Object3D();
      at.position.fromArray(target);
      at.updateMatrixWorld(true);
      vrm.lookAt.target = at;
      vrm.lookAt.update(0);
      const eyes = ['leftEye', 'rightEye'].map((name) => vrm.humanoid.getRawBoneNode(name));
      return {
        bent: Boolean(bent),
        target,
        turns: eyes.map((eye) => eye?.quaternion.toArray().map(rounded) ?? null),
        shares: ['lookUp', 'lookDown', 'lookLeft', 'lookRight'].map((name) => {
          const value = vrm.expressionManager.getValue(name);
          return value === null ? null : rounded(value);
        }),
      };
    });
  });
}

/** Turns, beside their parents, of all nodes that follow others. */
function follows({ vrm, nodes, names, constraints }) {
  const bent = [
    { leftUpperArm: [0.3, 0.2, -0.5, 0.8], leftHand: [0.7, 0.1, 0.2, 0.6] },
    {
      spine: [0.1, 0.4, 0, 0.9],
      leftUpperArm: [0, -0.6, 0.2, 0.7],
      leftLowerArm: [0.2, 0.5, 0.5, 0.6],
      leftHand: [-0.4, 0.3, 0.3, 0.8],
    },
  ];
  return bent.map((turns) => {
    const bones = Object.entries(turns).map(([name, turn]) => [nodes[names.indexOf(name)], turn]);
    for (const [node, turn] of bones) node.quaternion.fromArray(turn).normalize();
    vrm.scene.updateMatrixWorld(true);
    constraints.update();
    const told = [...constraints.constraints].map((constraint) => {
      const node = names[nodes.indexOf(constraint.destination)];
      return { node, turn: constraint.destination.quaternion.toArray().map(rounded) };
    });
    for (const [node] of bones) node.quaternion.identity();
    return { turns, told };
  });
}

/** Places of the ends of all springs while the motion plays, at 60 steps a second. */
async function swings({ vrm, nodes, names, constraints, springs }, motion) {
  const file = await loader().parseAsync(bare(fs.readFileSync(motion)), '');
  const proxy = new VRMLookAtQuaternionProxy(vrm.lookAt);
  proxy.name = 'look';
  vrm.scene.add(proxy);
  const clip = createVRMAnimationClip(file.userData.vrmAnimations[0], vrm);
  clip.tracks = clip.tracks.filter((track) => !track.name.startsWith('look'));
  const mixer = new AnimationMixer(vrm.scene);
  const action = mixer.clipAction(clip);
  action.setLoop(LoopOnce);
  action.clampWhenFinished = true;
  action.play();
  const ends = [...springs.joints].filter((joint) => joint.child).map((joint) => joint.child);
  const told = [];
  for (let step = 0; step <= STEPS; step += 1) {
    mixer.setTime(step / 60);
    vrm.humanoid.update();
    constraints?.update();
    vrm.scene.updateMatrixWorld(true);
    if (step === 0) springs.reset();
    else springs.update(1 / 60);
    vrm.scene.updateMatrixWorld(true);
    if (SEEN.includes(step)) {
      told.push({ step, places: ends.map((node) => [names[nodes.indexOf(node)], ...place(node)]) });
    }
  }
  return told;
}

/** JSON of short lines. */
function short(text) {
  return text.replace(/(.{1,110}[,{[])/g, '$1\n');
}

const [folder, puppet, motion] = process.argv.slice(2);
const model = (name) => path.join(folder, name);
const told = { three: REVISION, looks: [], follows: follows(await avatar(puppet)), swings: [] };
for (const file of [puppet, model('godette_vrm0.vrm'), model('godette_vrm1.vrm'), model('debug_robot_vrm1.vrm')]) {
  told.looks.push({ name: path.basename(file), moments: looks(await avatar(file)) });
}
for (const file of [puppet, model('godette_vrm0.vrm')]) {
  told.swings.push({ name: path.basename(file), moments: await swings(await avatar(file), motion) });
}
process.stdout.write(`${short(JSON.stringify(told))}\n`);
