// SPDX-License-Identifier: Apache-2.0
// A robot on a canvas, seen by a camera that the user turns. Nothing moves that neither the robot
// nor the user has moved, and nothing is drawn while nothing moves.
import { Box3, Color, DirectionalLight, GridHelper, HemisphereLight, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { RobotModel } from "./robot_model.ts";

const kTurn = Math.PI / 24;       ///< of a key
const kZoom = 0.88;               ///< likewise
const kAngle = 35;                ///< of the camera [deg]
const kFrom = new Vector3(1.1, -1.3, 0.75);
const kRoom = 1.15;               ///< around the robot
const kMostPixels = 2;            ///< for one of the page

export class Stage {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(kAngle, 1, 0.01, 100);
  private readonly controls: OrbitControls;
  private readonly sized: ResizeObserver;
  private readonly scheme = matchMedia("(prefers-color-scheme: dark)");
  private grid?: GridHelper;
  private due = false;
  private turned = false;  ///< by the user, so that it stays as it is

  /** @throws Error if the browser draws nothing in three dimensions */
  constructor(private readonly canvas: HTMLCanvasElement, private readonly model: RobotModel) {
    const context = canvas.getContext("webgl2", { antialias: true, alpha: true });
    if (!context) throw new Error("This browser has no WebGL, so nothing is drawn in 3D.");
    this.renderer = new WebGLRenderer({ canvas, context });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, kMostPixels));
    const light = new DirectionalLight("#ffffff", 1.6);
    light.position.set(2, -3, 4);
    this.scene.add(new HemisphereLight("#ffffff", "#8a8a8a", 1.7), light, model.object);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", this.show);
    this.controls.addEventListener("start", () => (this.turned = true));
    this.scheme.addEventListener("change", this.colour);
    this.sized = new ResizeObserver(this.fit);
    this.sized.observe(canvas.parentElement!);
    this.colour();
    this.home();
  }

  /** Of the robot as it stands. */
  private bounds(): Box3 {
    this.model.object.updateMatrixWorld(true);
    return new Box3().setFromObject(this.model.object);
  }

  /** Draws at the next frame. */
  show = (): void => {
    if (this.due) return;
    this.due = true;
    requestAnimationFrame(() => {
      this.due = false;
      this.renderer.render(this.scene, this.camera);
    });
  };

  /** The whole robot comes into sight, from its front. */
  home(): void {
    const { camera, controls } = this;
    const bounds = this.bounds();
    const radius = bounds.isEmpty() ? 1 : bounds.getSize(new Vector3()).length() / 2;
    const narrow = Math.min(1, camera.aspect);
    const distance = (radius * kRoom) / Math.sin((kAngle / 2) * (Math.PI / 180)) / narrow;
    if (!bounds.isEmpty()) bounds.getCenter(controls.target);
    camera.position.copy(kFrom).normalize().multiplyScalar(distance).add(controls.target);
    camera.near = distance / 100;
    camera.far = distance * 20;
    camera.updateProjectionMatrix();
    controls.minDistance = radius * 0.2;
    controls.maxDistance = distance * 8;
    controls.update();
    this.turned = false;
    this.show();
  }

  /** What a key does to the camera. @return whether it is one of these */
  key(key: string): boolean {
    const { controls } = this;
    const acts: Record<string, (() => void) | undefined> = {
      ArrowLeft: () => controls.rotateLeft(kTurn), ArrowRight: () => controls.rotateLeft(-kTurn),
      ArrowUp: () => controls.rotateUp(kTurn), ArrowDown: () => controls.rotateUp(-kTurn),
      "+": () => controls.dollyIn(kZoom), "=": () => controls.dollyIn(kZoom), "-": () => controls.dollyOut(kZoom),
      Home: () => this.home(), "0": () => this.home(),
    };
    const act = acts[key];
    if (!act) return false;
    this.turned = true;
    act();
    return true;
  }

  dispose(): void {
    this.sized.disconnect();
    this.scheme.removeEventListener("change", this.colour);
    this.controls.dispose();
    this.grid?.dispose();
    this.renderer.dispose();
  }

  private fit = (): void => {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement!;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (!this.turned) this.home();
    this.show();
  };

  /** As the page's tokens have it now. */
  private colour = (): void => {
    const style = getComputedStyle(this.canvas);
    const token = (name: string) => style.getPropertyValue(name).trim();
    this.model.plain[0].color.set(token("--robot-0"));
    this.model.plain[1].color.set(token("--robot-1"));
    this.model.hubs.color.set(token("--accent"));
    if (this.grid) this.scene.remove(this.grid);
    this.grid?.dispose();
    const bounds = this.bounds();
    const cell = cell_for(bounds);
    this.grid = new GridHelper(20 * cell, 20, new Color(token("--faint")), new Color(token("--grid")));
    this.grid.rotation.set(Math.PI / 2, 0, 0);
    this.grid.position.set(0, 0, bounds.isEmpty() ? 0 : Math.min(0, bounds.min.z)); // the ground that it stands on
    this.scene.add(this.grid);
    this.show();
  };
}

/** 0.01 m, 0.1 m or 1 m, as large as the robot asks for. */
function cell_for(bounds: Box3): number {
  const size = bounds.isEmpty() ? 1 : bounds.getSize(new Vector3()).length();
  return 10 ** Math.floor(Math.log10(Math.max(size, 0.01) / 2));
}
