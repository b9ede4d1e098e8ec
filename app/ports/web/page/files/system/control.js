// SPDX-License-Identifier: Apache-2.0
// Commands that are part of no other page.
import { command } from "../appliance/api.js";
import { Card } from "../elements/card.js";
import { commandButton, element, field, setText } from "../elements/elements.js";
import { texts } from "../texts.js";

const { control } = texts;

const number = (label, name, min) => field(label, { name, type: "number", min, max: 65535, step: 1, value: min });
const choice = (label, select) => element("label", {}, label, " ", select);

// Replaces the choices, {text, value} of each, by others, and keeps the chosen one.
function offer(select, choices) {
  const chosen = select.value;
  const isSame = ({ text, value }, index) => select[index]?.text === text && select[index].value === String(value);
  if (choices.length === select.length && choices.every(isSame)) return;
  select.replaceChildren(...choices.map(({ text, value }) => element("option", { value }, text)));
  if (choices.some(({ value }) => String(value) === chosen)) select.value = chosen;
}

export class Control {
  // `isIntegrator`: the user may give an integrator's commands.
  constructor(views, recipe, isIntegrator) {
    this.said = element("p", { role: "status" });
    this.view = element("select", { name: "view" });
    this.card = new Card("control", texts.cards.titles.control);
    this.recipe = element("select", { name: "recipe" });
    this.card.append(element("div", { className: "components" },
      this.#group(control.measuring, [], [["start"], ["stop"], ["trigger"]]),
      this.#group(control.process, [], [["set_process_active", { active: 1 }, "active"],
        ["set_process_active", { active: 0 }, "inactive"]]),
      this.#group(control.recipes, [choice(control.recipe, this.recipe)], [["select_recipe"]]),
      this.#group(control.views, [choice(texts.process.view, this.view)],
        [["snapshot"], ["select_view"]]),
      ...(isIntegrator ? [
        this.#group(control.lines, [number(control.line, "line", 0)], [["pulse"]]),
        this.#group(control.service, [], [["restart"]])] : [])), this.said);
    this.root = this.card.root;
    views.addEventListener("change", () => offer(this.view,
      views.all.map(({ name, index }) => ({ text: name, value: index }))));
    const offerRecipes = () => offer(this.recipe,
      recipe.stated.recipes.map((one) => ({ text: `${one.number} ${one.name}`, value: one.number })));
    recipe.addEventListener("change", offerRecipes);
    offerRecipes();
  }

  // `commands`: [name, values, name of its label] of each; more values are those of the fields.
  #group(title, fields, commands) {
    const form = element("form", {}, ...fields.flatMap((one) => [one, " "]));
    form.addEventListener("submit", (event) => event.preventDefault());
    form.append(...commands.flatMap(([name, values = {}, label = name]) => [
      commandButton(control[label], name, () => this.#give(name, form, values)), " "]));
    return element("section", {}, element("h4", {}, title), form);
  }

  async #give(name, form, values) {
    if (!form.reportValidity() || (name === "restart" && !confirm(control.restartAsks))) return;
    const typed = [...new FormData(form)].map(([field, value]) => [field, Number(value)]);
    const why = await command(name, { ...Object.fromEntries(typed), ...values });
    setText(this.said, why ? texts.refused(why) : control.done(name));
    this.said.classList.toggle("wrong", why !== "");
  }

  status({ system }) {
    this.card.say(control.state(system.recipe, system.process_active));
  }
}
