// SPDX-License-Identifier: Apache-2.0
// Descriptions of the appliance's figures, and commands to it.
import { translated } from "../texts.js";

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

// Descriptions by kind of component ("system", "cameras"), then by name: {title, description, unit, codes}; only
// signals have titles.
export async function describeFigures() {
  const answer = await fetch("api/v1/openapi.json");
  if (!answer.ok) throw new Error(`status ${answer.status}`);
  const kinds = (await answer.json()).components.schemas.Status.properties;
  const figures = {};
  for (const [kind, schema] of Object.entries(kinds)) {
    const properties = schema.items?.properties ?? schema.properties ?? {};
    figures[kind] = Object.fromEntries(
      Object.entries(properties).map(([name, figure]) => [name, described(figure)]));
  }
  return figures;
}

// Members of the answer, with the reason as `refused` if it was not done.
export async function answerTo(path, body) {
  try {
    const answer = await fetch(path, {
      method: "POST",
      headers: { "Content-Type": "application/json", "X-Orbwatch": "page" },
      body: JSON.stringify(body),
    });
    const result = await answer.json();
    return answer.ok ? result : { refused: result.error ?? result.result_text };
  } catch (error) {
    return { refused: error.message };
  }
}

// Empty: done; otherwise the reason.
export const post = async (path, body) => (await answerTo(path, body)).refused ?? "";
export const command = (name, body) => post(`api/v1/command/${name}`, body);
