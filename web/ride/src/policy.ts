// SPDX-License-Identifier: Apache-2.0
import type { Question } from "./host.ts";
import type { Access } from "./served.ts";

interface Rule {
  who: string;
  access: readonly string[];
  components: readonly string[];
}

const kAccesses: readonly string[] = ["read", "command", "configure"] satisfies Access[];
const kWho = /^(\*|local|local:.+|[^@]+@tls|page@web|\*@web)$/;

/** `allow WHO ACCESS COMPONENTS`; undefined: the line has no rule. */
function ruleOf(line: string, number: number): Rule | undefined {
  const words = line.replace(/#.*/, "").trim().split(/\s+/);
  if (words[0] === "") return undefined;
  const wrong = (text: string) => new TypeError(`line ${number} of the policy: ${text}`);
  const [verb, who = "", access = "", components = ""] = words;
  if (verb !== "allow" || words.length !== 4) {
    throw wrong(`expected 'allow WHO ACCESS COMPONENTS', found '${line.trim()}'`);
  }
  if (!kWho.test(who)) throw wrong(`expected NAME@tls, *@tls, page@web, local:USER, local or *, found '${who}'`);
  const rule = { who, access: access.split(","), components: components.split(",") };
  const unknown = rule.access.find((each) => !kAccesses.includes(each));
  if (unknown !== undefined) throw wrong(`expected read, command or configure, found '${unknown}'`);
  if (rule.components.includes("")) throw wrong("expected a component's name at the comma");
  return rule;
}

function speaksOf(rule: string, who: string): boolean {
  if (rule === "*" || rule === who) return true;
  if (rule === "local" || rule === "local:*") return who.startsWith("local:");
  return rule.startsWith("*@") && who.length > rule.length - 1 && who.endsWith(rule.slice(1));
}

/**
 * Who may do what, from the text of a policy file: what any rule allows is allowed, and nothing else.
 * Throws a TypeError that says which line is none.
 */
export function policy(text: string): (question: Question) => boolean {
  const rules = text.split("\n").flatMap((line, i) => ruleOf(line, i + 1) ?? []);
  return ({ who, component, access }) =>
    rules.some(
      (rule) =>
        rule.access.includes(access) &&
        speaksOf(rule.who, who) &&
        rule.components.some((name) => name === "*" || name === component),
    );
}
