// What the appliance says about its figures, and commands to it.

// Its unit stands at the end of a figure's description, too.
function described(figure) {
  const unit = figure["x-unit"] ?? "";
  const description = figure.description ?? "";
  const end = `, ${unit}`;
  const hasEnd = unit && description.endsWith(end);
  return { unit, description: hasEnd ? description.slice(0, -end.length) : description };
}

// By kind of component ("system", "cameras"), then by name: {description, unit}.
export async function describeFigures() {
  const answer = await fetch("/api/v1/openapi.json");
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

// Empty when it was done, else why not.
export async function post(path, body) {
  try {
    const answer = await fetch(path, {
      method: "POST",
      headers: { "Content-Type": "application/json", "X-Orbwatch": "page" },
      body: JSON.stringify(body),
    });
    const result = await answer.json();
    return answer.ok ? "" : (result.error ?? result.result_text);
  } catch (error) {
    return error.message;
  }
}

export const command = (name, body) => post(`/api/v1/command/${name}`, body);
