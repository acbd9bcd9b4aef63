// SPDX-License-Identifier: Apache-2.0

/** The model's own name if nobody has it, else the first free of `Model2`, `Model3`, ... */
export function free_name(model: string, taken: Iterable<string>): string {
  const names = new Set(taken);
  const stem = model.replace(/[^A-Za-z0-9_]/g, "") || "Component";
  if (!names.has(stem)) return stem;
  let number = 2;
  while (names.has(`${stem}${number}`)) ++number;
  return `${stem}${number}`;
}
