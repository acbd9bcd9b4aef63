// SPDX-License-Identifier: Apache-2.0
// A robot as its description (URDF) has it, ready to be drawn. Nothing is fetched for it.
import { ConeGeometry, CylinderGeometry, Mesh, MeshPhongMaterial, type Object3D, Vector3 } from "three";
import URDFLoader, { type URDFJoint, type URDFRobot } from "urdf-loader";
import { type JointShape, moving_joints, type Robot, unit_of } from "./robots.ts";

/** A joint that values may move. */
export interface Joint {
  name: string;
  unit: string;               ///< `rad` or `m`
  range?: [number, number];   ///< undefined: it turns without end
}

export class RobotModel {
  readonly joints: Joint[];
  readonly name: string;
  readonly object: URDFRobot;
  /** How many shapes are meshes in files of their own, which are not drawn. */
  readonly meshes: number;
  /** Of what the description gives no colour: those of links that follow each other, in turns. */
  readonly plain: [MeshPhongMaterial, MeshPhongMaterial];
  /** The link whose axes are drawn; empty: none. */
  readonly tip: string;
  /** Of joints of links that have no shape. */
  readonly hubs: MeshPhongMaterial;

  /** @throws Error if the text is no description of a robot */
  constructor(text: string, { base, tip }: Robot) {
    const description = parsed(text);
    this.meshes = description.querySelectorAll("visual mesh").length;
    this.object = built(description);
    this.name = this.object.robotName;
    const all = Object.values(this.object.joints).filter((one) => !("mimicJoint" in one));
    for (const one of Object.values(this.object.joints)) one.ignoreLimits = true; // what was measured is shown as it is
    this.joints = moving_joints(all.map(shape_of), base, tip).map(({ joint }) => described(joint));
    const plastic = () => new MeshPhongMaterial({ shininess: 25 });
    this.plain = [plastic(), plastic()];
    this.hubs = plastic();
    add_bones(this.object, this.hubs);
    this.tip = add_frame(this.object, tip || only_end(this.object));
    paint(this.object, this.plain, 0);
  }

  move(joint: string, position: number): void {
    this.object.setJointValue(joint, position);
  }

  dispose(): void {
    this.object.traverse((one) => is_mesh(one) && (one.geometry.dispose(), one.material.dispose()));
  }
}

function parsed(text: string): Document {
  const description = new DOMParser().parseFromString(text, "text/xml");
  const wrong = description.querySelector("parsererror")?.textContent ?? "";
  if (wrong) throw new Error(`the description is no XML: ${wrong.split("\n")[1] ?? wrong}`);
  if (description.documentElement.nodeName !== "robot") throw new Error(`the description begins with <${description.documentElement.nodeName}>, expected <robot>`);
  for (const one of description.querySelectorAll("texture")) one.remove();
  return description;
}

function built(description: Document): URDFRobot {
  const loader = new URDFLoader();
  loader.packages = ".";
  loader.loadMeshCb = (_path, _manager, _material, done) => done(null as unknown as Object3D);
  return loader.parse(description);
}

function shape_of(joint: URDFJoint): JointShape & { joint: URDFJoint } {
  const link = (tag: string) => joint.urdfNode?.querySelector(tag)?.getAttribute("link") ?? "";
  return { name: joint.urdfName, type: joint.jointType, parent: link("parent"), child: link("child"), joint };
}

function described({ urdfName, jointType, limit: { lower, upper } }: URDFJoint): Joint {
  return { name: urdfName, unit: unit_of(jointType), range: jointType !== "continuous" && upper > lower ? [lower, upper] : undefined };
}

const is_mesh = (object: Object3D): object is Mesh => "isMesh" in object;

const kHub = "hub";
const is_moving = (object: Object3D): boolean => "isURDFJoint" in object && (object as URDFJoint).jointType !== "fixed";

/** The loader makes a material without a name where the description names none. @param turn  grows with each joint that moves */
function paint(object: Object3D, plain: RobotModel["plain"], turn: number): void {
  if (is_mesh(object) && object.material.name === "") object.material = plain[turn % 2]!;
  for (const child of object.children) paint(child, plain, turn + (is_moving(child) ? 1 : 0));
}

const kFewest = 0.05;  ///< what a robot without lengths is taken for [m]

const has_shape = (link: Object3D): boolean => link.children.some((one) => "isURDFVisual" in one);

/** It is fixed to a link with a shape, which shows both. */
const is_shown = (joint: URDFJoint): boolean => !is_moving(joint) && joint.children.some(has_shape);

const thickness_of = (robot: URDFRobot): number => 0.03 * Math.max(kFewest, ...Object.values(robot.joints).map((one) => one.position.length()));

/** Links without a shape are bones from joint to joint, with a hub at each joint that moves. */
function add_bones(robot: URDFRobot, hubs: MeshPhongMaterial): void {
  hubs.name = kHub;
  const thickness = thickness_of(robot);
  for (const link of Object.values(robot.links)) {
    if (has_shape(link)) continue;
    for (const joint of link.children.filter((one): one is URDFJoint => "isURDFJoint" in one)) {
      if (joint.position.length() > 1e-6 && !is_shown(joint)) link.add(bone(joint.position, thickness));
      if (is_moving(joint)) joint.add(hub(joint.axis, thickness, hubs));
    }
  }
}

const kAlong = new Vector3(0, 1, 0);  ///< a cylinder's axis

function bone(to: Vector3, radius: number, material = new MeshPhongMaterial()): Object3D {
  const mesh = new Mesh(new CylinderGeometry(radius, radius, to.length(), 20), material);
  mesh.position.copy(to).multiplyScalar(0.5);
  mesh.quaternion.setFromUnitVectors(kAlong, to.clone().normalize());
  return mesh;
}

function hub(axis: Vector3, thickness: number, material: MeshPhongMaterial): Object3D {
  const mesh = new Mesh(new CylinderGeometry(1.6 * thickness, 1.6 * thickness, 2.8 * thickness, 28), material);
  mesh.quaternion.setFromUnitVectors(kAlong, axis.clone().normalize());
  return mesh;
}

/** x, y and z, as everybody draws them: readable in light and dark. */
const kAxes = [["x", new Vector3(1, 0, 0), "#e0483c"], ["y", new Vector3(0, 1, 0), "#3fae55"], ["z", new Vector3(0, 0, 1), "#3f83e8"]] as const;

/** The link at the end of the robot, such as its tool; empty: it has several, or none. */
function only_end(robot: URDFRobot): string {
  const ends = Object.entries(robot.links).filter(([, link]) => !link.children.some((one) => "isURDFJoint" in one));
  return ends.length === 1 ? ends[0]![0] : "";
}

/** The axes of a link, such as the tool's. @return its name; empty if the robot has no such link */
function add_frame(robot: URDFRobot, name: string): string {
  const link = robot.links[name];
  if (!link) return "";
  const thickness = thickness_of(robot);
  for (const [axis, along, colour] of kAxes) {
    const material = new MeshPhongMaterial({ shininess: 25 });
    material.name = axis;
    material.color.set(colour);
    const head = new Mesh(new ConeGeometry(0.9 * thickness, 2.2 * thickness, 16), material);
    head.position.copy(along).multiplyScalar(8 * thickness);
    head.quaternion.setFromUnitVectors(kAlong, along);
    link.add(bone(along.clone().multiplyScalar(8 * thickness), 0.35 * thickness, material), head);
  }
  return name;
}
