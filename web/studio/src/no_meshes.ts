// SPDX-License-Identifier: Apache-2.0
// In place of three.js' readers of meshes, which urdf-loader asks for by name: robot_model.ts gives it
// another one, so that they are never called.
export class STLLoader {}
export class ColladaLoader {}
