// SPDX-License-Identifier: Apache-2.0
// Of three.js what the robot's view uses: its own types are a package of nine.
declare module "three" {
  export class Vector3 {
    x: number;
    y: number;
    z: number;
    constructor(x?: number, y?: number, z?: number);
    set(x: number, y: number, z: number): this;
    copy(from: Vector3): this;
    clone(): Vector3;
    add(other: Vector3): this;
    length(): number;
    normalize(): this;
    multiplyScalar(by: number): this;
  }
  export class Quaternion {
    setFromUnitVectors(from: Vector3, to: Vector3): this;
  }
  export class Color {
    constructor(color?: string);
    set(color: string): this;
  }
  export class Box3 {
    min: Vector3;
    max: Vector3;
    setFromObject(object: Object3D): this;
    isEmpty(): boolean;
    getCenter(into: Vector3): Vector3;
    getSize(into: Vector3): Vector3;
  }
  export class Object3D {
    name: string;
    position: Vector3;
    rotation: Vector3;
    quaternion: Quaternion;
    up: Vector3;
    parent: Object3D | null;
    children: Object3D[];
    visible: boolean;
    add(...objects: Object3D[]): this;
    remove(...objects: Object3D[]): this;
    traverse(visit: (object: Object3D) => void): void;
    updateMatrixWorld(force?: boolean): void;
  }
  export class Material {
    name: string;
    dispose(): void;
  }
  export class MeshPhongMaterial extends Material {
    color: Color;
    constructor(settings?: { color?: string; shininess?: number });
  }
  export class BufferGeometry {
    dispose(): void;
  }
  export class CylinderGeometry extends BufferGeometry {
    constructor(top: number, bottom: number, height: number, segments?: number);
  }
  export class ConeGeometry extends BufferGeometry {
    constructor(radius: number, height: number, segments?: number);
  }
  export class Mesh extends Object3D {
    isMesh: true;
    geometry: BufferGeometry;
    material: Material;
    constructor(geometry?: BufferGeometry, material?: Material);
  }
  export class GridHelper extends Object3D {
    material: Material;
    constructor(size: number, divisions: number, centre?: Color, lines?: Color);
    dispose(): void;
  }
  export class Scene extends Object3D {}
  export class HemisphereLight extends Object3D {
    constructor(sky: string, ground: string, intensity: number);
  }
  export class DirectionalLight extends Object3D {
    constructor(color: string, intensity: number);
  }
  export class PerspectiveCamera extends Object3D {
    aspect: number;
    near: number;
    far: number;
    constructor(angle: number, aspect: number, near: number, far: number);
    updateProjectionMatrix(): void;
  }
  export class WebGLRenderer {
    constructor(settings: { canvas: HTMLCanvasElement; context: WebGL2RenderingContext });
    setPixelRatio(ratio: number): void;
    setSize(width: number, height: number, style: boolean): void;
    render(scene: Scene, camera: PerspectiveCamera): void;
    dispose(): void;
  }
  export class LoadingManager {}
}

declare module "three/examples/jsm/controls/OrbitControls.js" {
  import type { PerspectiveCamera, Vector3 } from "three";
  export class OrbitControls {
    target: Vector3;
    minDistance: number;
    maxDistance: number;
    constructor(camera: PerspectiveCamera, element: HTMLElement);
    rotateLeft(angle: number): void;
    rotateUp(angle: number): void;
    dollyIn(by: number): void;
    dollyOut(by: number): void;
    update(): boolean;
    addEventListener(event: "change" | "start", handler: () => void): void;
    dispose(): void;
  }
}
