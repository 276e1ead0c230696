import "../style/common.css";
import "./app.css";
import type { Start } from "../data/answers";
import { ModelText } from "../data/model_text";
import { fromHash } from "./address";
import { buildPage } from "./page";
import { freshState, type State } from "./state";
import { Workbench } from "./workbench";

/** The state of the address, else the model that the program was started with. */
async function firstState(start: Start): Promise<State> {
  const linked = await fromHash(location.hash);
  if (linked) return linked;
  let model = new ModelText(start.text);
  for (const [name, value] of Object.entries(start.values)) model = model.writeNumber(["parameters", name], value);
  return freshState(start.file.split("/").pop() ?? "model.yaml", model.text);
}

async function main(): Promise<void> {
  const start = (await (await fetch("api/start")).json()) as Start;
  const bench = new Workbench(start, await firstState(start));
  const root = document.getElementById("app");
  if (root) buildPage(bench, root);
  bench.begin();
}

void main();
