// SPDX-License-Identifier: Apache-2.0
// Makes of texts what `armature check --json` would, as far as the page's tests need it.
import { isMap, isScalar, isSeq, type Node, parseDocument, type YAMLMap } from "yaml";
import { type Checked, type Component, type Connection, type Diagnostic, type Model, split_member } from "../../src/checked.ts";

export function check(file: string, texts: ReadonlyMap<string, string>, models: Model[]): Checked {
  return new Check(file, texts, models).run();
}

const is_range = /^(.*?)\{(\d+)\.\.(\d+)\}(.*)$/;

function numbers_of(key: string): { name: string; i: number }[] {
  const range = is_range.exec(key);
  if (!range) return [{ name: key, i: 0 }];
  const [, before, low, high, behind] = range as unknown as [string, string, string, string, string];
  return Array.from({ length: Number(high) - Number(low) + 1 }, (_, k) => ({ name: `${before}${Number(low) + k}${behind}`, i: Number(low) + k }));
}

interface Composite {
  parts: YAMLMap;
  connections: { from: string; to: string; place: Place }[];
  exports: Map<string, string>;
  file: string;
}

interface Place {
  file: string;
  line: number;
  column: number;
}

class Check {
  private readonly diagnostics: Diagnostic[] = [];
  private readonly components: Component[] = [];
  private readonly connections: Connection[] = [];
  private readonly ranges = new Map<string, number[]>();
  private readonly composites = new Map<string, Composite>();
  private readonly aliases = new Map<string, string>();
  private application = "";
  private modes: Checked["modes"] = [];

  constructor(private readonly file: string, private readonly texts: ReadonlyMap<string, string>, private readonly models: Model[]) {}

  run(): Checked {
    const documents = [...this.texts].map(([file, text]) => ({ file, document: parseDocument(text) }));
    for (const { file, document } of documents) {
      for (const error of document.errors) this.error(this.place(file, error.pos[0]), error.message.split("\n")[0]!);
    }
    if (this.diagnostics.length === 0) this.read(documents.map(({ file, document }) => ({ file, map: document.contents as YAMLMap | null })));
    const has_mistakes = this.diagnostics.length > 0;
    if (this.components.length === 0 && !has_mistakes) this.diagnostics.push({ severity: "error", message: "the file has no components", hint: "add them under components:", file: this.file });
    const errors = this.diagnostics.filter((one) => one.severity === "error").length;
    return {
      file: this.file, application: this.application, ok: errors === 0, errors, diagnostics: this.diagnostics, components: this.components,
      connections: this.connections, threads: errors === 0 ? this.threads() : [],
      modes: this.modes,
    };
  }

  private read(documents: { file: string; map: YAMLMap | null }[]): void {
    for (const { file, map } of documents) {
      if (!isMap(map)) continue;
      if (file === this.file) this.application = String(map.get("application") ?? "");
      const modes = map.get("modes");
      if (isMap(modes)) this.modes = modes.items.map(({ key }) => ({ name: String(key), initial: (map.get("mode") ?? String(modes.items[0]?.key)) === String(key) }));
      this.read_composites(file, map.get("composites"));
    }
    for (const { file, map } of [...documents].reverse()) if (isMap(map)) this.read_components(file, map.get("components") as YAMLMap | null);
    for (const { file, map } of documents) if (isMap(map)) this.read_connections(file, map.get("connections"));
  }

  private place(file: string, offset: number): Place {
    const before = this.texts.get(file)!.slice(0, offset);
    const line = before.split("\n");
    return { file, line: line.length, column: bytes_in(line.at(-1)!) + 1 };
  }

  private error(place: Place, message: string, hint?: string, fix?: { found: string; by: string }): void {
    const one: Diagnostic = { severity: "error", message, ...place };
    if (hint) one.hint = hint;
    if (fix) {
      const line = this.texts.get(place.file)!.split("\n")[place.line - 1]!;
      const column = line.indexOf(fix.found, place.column - 1) + 1;
      if (column > 0) one.fix = { file: place.file, line: place.line, column, ...fix };
    }
    this.diagnostics.push(one);
  }

  private read_composites(file: string, all: unknown): void {
    if (!isMap(all)) return;
    for (const { key, value } of all.items) {
      const map = value as YAMLMap;
      const ports = (map.getIn(["exports", "ports"]) as YAMLMap | undefined)?.toJSON() as Record<string, string> | undefined;
      const connections = ((map.get("connections") as { items: Node[] } | undefined)?.items ?? []).map((one) => {
        const [from, to] = String((one as unknown as { value: string }).value).split(/\s*->\s*/);
        return { from: from!, to: to!, place: this.place(file, one.range![0]) };
      });
      this.composites.set(String(key), { parts: map.get("components") as YAMLMap, connections, exports: new Map(Object.entries(ports ?? {})), file });
    }
  }

  private read_components(file: string, map: YAMLMap | null, prefix = ""): void {
    if (!isMap(map)) return;
    for (const { key, value } of map.items) {
      const written = String(key);
      const all = numbers_of(written);
      if (is_range.test(written)) this.ranges.set(written.replace(/\{.*?\}/, "{i}"), all.map((one) => one.i));
      const place = this.place(file, (key as Node).range![0]);
      for (const { name } of all) this.add(prefix + name, value as YAMLMap, place, file);
    }
  }

  private add(name: string, entry: YAMLMap | null, place: Place, file: string): void {
    const plain = (isMap(entry) ? entry.toJSON() : { model: isScalar(entry as unknown) ? String(entry) : "" }) as Record<string, unknown>;
    if (plain["override"]) return this.override(name, (plain["properties"] ?? {}) as Record<string, unknown>);
    const model_name = String(plain["model"] ?? "");
    const composite = this.composites.get(model_name);
    if (composite) {
      this.read_components(composite.file, composite.parts, `${name}.`);
      for (const one of composite.connections) this.connections.push({ kind: "data", from: `${name}.${one.from}`, to: `${name}.${one.to}`, ...one.place, triggers: false });
      for (const [exported, inner] of composite.exports) this.aliases.set(`${name}.${exported}`, `${name}.${inner}`);
      return;
    }
    const model = this.models.find((one) => one.name === model_name);
    if (!model) {
      const near = this.models.find((one) => one.name.startsWith(model_name.slice(0, 4)));
      return this.error(place, `unknown model '${model_name}'`, near && `did you mean '${near.name}'?`, near && { found: model_name, by: near.name });
    }
    const values = (plain["properties"] ?? {}) as Record<string, unknown>;
    for (const key of Object.keys(values)) {
      if (!model.properties.some((one) => one.name === key)) this.error(place, `'${name}' has no property '${key}'`, `its properties are ${model.properties.map((one) => one.name).join(", ")}`);
    }
    const properties = model.properties.map((one) => ({ ...one, value: text_of(values[one.name]) ?? one.default ?? "" }));
    const activity = activity_of(plain["activity"]);
    const thread = activity.kind === "periodic" ? name.replace(/\d+$/, "") : undefined;
    const unit = properties.find((one) => one.name === "Unit")?.value;
    const ports = { inputs: model.inputs, outputs: model.outputs.map((one) => (unit && one.unit === "" && one.type === "double" ? { ...one, unit } : one)) };
    void file;
    this.components.push({ ...model, ...ports, name, model: model_name, ...place, activity, thread, properties });
  }

  private override(name: string, values: Record<string, unknown>): void {
    const component = this.components.find((one) => one.name === name);
    for (const property of component?.properties ?? []) property.value = text_of(values[property.name]) ?? property.value;
  }

  private read_connections(file: string, all: unknown): void {
    if (!isSeq(all)) return;
    for (const item of all.items as Node[]) {
      const place = this.place(file, item.range![0]);
      if (isMap(item)) this.read_map(item.toJSON() as Record<string, string>, place);
      else {
        const [from, to] = String((item as unknown as { value: string }).value).split(/\s*->\s*/);
        this.connect(from ?? "", to ?? "", place);
      }
    }
  }

  private read_map(entry: Record<string, string>, place: Place): void {
    if (entry["from"]) return this.connect(entry["from"], entry["to"] ?? "", place);
    const name = entry["name"] ?? "EventCommand1";
    const none = { properties: [], outputs: [], port_arrays: [], operations: [], requirements: [] };
    const given = Object.entries((entry["with"] ?? {}) as Record<string, unknown>).filter(([, from]) => this.is_port(String(from)));
    const inputs = given.map(([parameter]) => ({ name: parameter, type: "double", unit: "", doc: "a parameter of the command" }));
    const events = ["Done", "Failed"].map((one) => ({ name: one, signature: "void()", arguments: [], doc: "" }));
    this.components.push({ ...none, inputs, events, name, model: "EventCommand", ...place, activity: { kind: "sequential" } });
    for (const [parameter, from] of given) this.connections.push({ kind: "data", from: String(from), to: `${name}.${parameter}`, ...place });
    this.connections.push({ kind: "event", from: entry["on"]!, to: `${name}.on` }, { kind: "command", from: `${name}.do`, to: entry["do"]! });
  }

  private is_port(path: string): boolean {
    const [owner, member] = split_member(path);
    return this.components.some((one) => one.name === owner && one.outputs.some((port) => port.name === member));
  }

  private connect(from: string, to: string, place: Place): void {
    const owners = [from, to].map((path) => split_member(path)[0]);
    const indices = owners.flatMap((owner) => this.ranges.get(owner) ?? []);
    const all = from.includes("{i}") || to.includes("{i}") ? [...new Set(indices)] : [0];
    for (const i of all) this.connect_one(from.replaceAll("{i}", String(i)), to.replaceAll("{i}", String(i)), place);
  }

  private connect_one(from: string, to: string, place: Place): void {
    const source = this.aliases.get(from) ?? from;
    const sink = this.aliases.get(to) ?? to;
    const output = this.port(source, "outputs", place);
    const input = this.port(sink, "inputs", place);
    if (!output || !input) return;
    if (output.unit !== input.unit && output.unit && input.unit) this.error(place, `'${from}' is in ${output.unit}, '${to}' in ${input.unit}`);
    this.connections.push({ kind: "data", from: source, to: sink, ...place, triggers: input.triggers ?? false, crosses_threads: false, delayed: false });
  }

  private port(path: string, side: "inputs" | "outputs", place: Place) {
    const [owner, member] = split_member(path);
    const component = this.components.find((one) => one.name === owner);
    if (!component) return void this.error(place, `unknown component '${owner}'`);
    const port = component[side].find((one) => one.name === member);
    const near = component[side].find((one) => one.name.startsWith(member.slice(0, 3)));
    if (!port) this.error(place, `'${owner}' has no ${side.slice(0, -1)} port '${member}'`, near && `did you mean '${near.name}'?`, near && { found: member, by: near.name });
    return port;
  }

  private threads(): Checked["threads"] {
    const names = [...new Set(this.components.flatMap((one) => one.thread ?? []))];
    for (const one of this.components) one.thread ??= names[0];
    return names.map((name) => {
      const members = this.components.filter((one) => one.thread === name);
      return { name, activity: members[0]!.activity, order: members.map((one) => one.name) };
    });
  }
}

const bytes_in = (text: string): number => new TextEncoder().encode(text).length;

const text_of = (value: unknown): string | undefined => (value === undefined ? undefined : typeof value === "object" ? JSON.stringify(value) : String(value));

function activity_of(written: unknown): Component["activity"] {
  if (typeof written !== "object" || written === null) return { kind: String(written ?? "sequential") };
  const { periodic, priority } = written as { periodic?: string; priority?: number };
  const period = /([\d.]+)\s*(ms|s|us)/.exec(String(periodic ?? ""));
  if (!period) return { kind: "triggered" };
  const scale = { s: 1e9, ms: 1e6, us: 1e3 }[period[2] as "s" | "ms" | "us"];
  return { kind: "periodic", period_ns: Number(period[1]) * scale, scheduler: priority ? "realtime" : "other", priority };
}
