// SPDX-License-Identifier: Apache-2.0
// Data of the appliance, descriptions of its figures, and commands to it.
import { translated } from "../texts.js";

const kPatienceMs = 10000; // a proxy may wait for an appliance that hangs for much longer
// Longer than `request_timeout_ms` of [web] by default, until which the appliance may begin to execute a command.
const kCommandMs = 15000;

// Options of a fetch that gives up in time, so that a request lost on its way blocks none that follow.
export const patience = (ms = kPatienceMs) => ({ signal: AbortSignal.timeout(ms) });

// A figure's description also ends with its unit. A code has its numbers by name.
function described(figure) {
  const unit = figure["x-unit"] ?? "";
  const description = figure.description ?? "";
  const end = `, ${unit}`;
  const hasEnd = unit && description.endsWith(end);
  const codes = Object.fromEntries(
    (figure["x-enum-varnames"] ?? []).map((name, n) => [name, figure.enum[n]]));
  return { title: translated(figure.title ?? ""), unit, codes,
    description: hasEnd ? description.slice(0, -end.length) : description };
}

// JSON of a path. Throws when there is none in time.
export async function read(path) {
  const answer = await fetch(path, patience());
  if (!answer.ok) throw new Error(`status ${answer.status}`);
  return answer.json();
}

const description = () => read("api/v1/openapi.json");

// `version` of the appliance, and `figures`: descriptions by kind of component ("system", "cameras"), then by name:
// {title, description, unit, codes}; only signals have titles.
export async function describeAppliance() {
  const { info, components } = await description();
  const figures = {};
  for (const [kind, schema] of Object.entries(components.schemas.Status.properties)) {
    const properties = schema.items?.properties ?? schema.properties ?? {};
    figures[kind] = Object.fromEntries(
      Object.entries(properties).map(([name, figure]) => [name, described(figure)]));
  }
  return { version: info.version, figures };
}

export const versionOfAppliance = async () => (await description()).info.version;

// Members of the answer, with the reason as `refused` if it was not done. `limit`: what patience() returns; without it,
// the answer may take as long as the appliance works on it.
export async function answerTo(path, body, limit) {
  try {
    const answer = await fetch(path, {
      method: "POST",
      headers: { "Content-Type": "application/json", "X-Orbwatch": "page" },
      body: JSON.stringify(body),
      ...limit,
    });
    const result = await answer.json();
    return answer.ok ? result : { refused: result.error ?? result.result_text };
  } catch (error) {
    return { refused: error.message };
  }
}

// Empty: done; otherwise the reason.
export const post = async (path, body, limit) => (await answerTo(path, body, limit)).refused ?? "";
export const command = (name, body) => post(`api/v1/command/${name}`, body, patience(kCommandMs));
