// SPDX-License-Identifier: Apache-2.0
// client ADDRESS: a program of the plant that reads an appliance by types generated from its OpenAPI description, and
// acknowledges its alarms. Prints as JSON what it read.
import createClient from "openapi-fetch";
import type { paths } from "./api.js";

declare const process: { argv: string[] };

const appliance = createClient<paths>({ baseUrl: process.argv[2] });

/** The answer's content. Throws the reason of a refusal. */
function content<T>({ data, error }: { data?: T; error?: { error: string } | { result_text: string } }): T {
  if (data !== undefined) return data;
  throw new Error(error && "error" in error ? error.error : error?.result_text);
}

const status = content(await appliance.GET("/api/v1/status"));
const { views } = content(await appliance.GET("/api/v1/views"));
const recipe = content(await appliance.GET("/api/v1/recipe"));
const histories = await Promise.all(recipe.regions.map(async ({ name }) => content(await appliance.GET(
  "/api/v1/history", { params: { query: { region: name, figure: "hot_spot_width" } } }))));
const acknowledgement = content(await appliance.POST("/api/v1/command/acknowledge_alarm", { body: { alarm: 0 } }));

const runs: boolean = status.system.state === 1;
const fields: (number | null)[] = views.map(({ configured }) => configured.h_fov);
console.log(JSON.stringify({
  runs,
  cameras: status.cameras?.map(({ name }) => name),
  views: views.map(({ name }) => name),
  fields,
  regions: recipe.regions.map(({ name }) => name),
  units: histories.map(({ unit }) => unit),
  acknowledgement: acknowledgement.result_text,
}));
