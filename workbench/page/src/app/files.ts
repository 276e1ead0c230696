// Opening and saving: by a button, by dropping a file, by Ctrl+S. Other programs' files are read by the program.
import { ask, AskingError } from "./asking";
import { download, h } from "./dom";
import type { Workbench } from "./workbench";

interface Imported {
  text: string;
  source: string; // "" of text that is in no other program's form
  notes: string[];
}

const longest = 4 << 20; // bytes; the program reads no more either

/** Its own format as it is; what came of another one, with notes. A mechanism file beside a foreign one belongs to it, as the loops of a URDF. */
export async function openFiles(bench: Workbench, files: File[]): Promise<string[]> {
  const own = (file: File): boolean => /\.ya?ml$/i.test(file.name);
  const main = files.find((file) => !own(file)) ?? files[0];
  if (!main) return [];
  if (files.some((file) => file.size > longest)) return [`${main.name} has more than 4 MB`];
  const text = await main.text();
  if (text.trim() === "") return [`${main.name} is empty`];
  if (own(main)) {
    bench.open(main.name, text);
    return [];
  }
  const side = files.find((file) => file !== main);
  return openForeign(bench, main.name, text, side && { side: await side.text(), side_file: side.name });
}

/** A file of another program, or an address of one, which the program turns into a mechanism file. */
async function openForeign(bench: Workbench, file: string, text: string, side: object = {}): Promise<string[]> {
  try {
    const answer = await ask<Imported>("import", { file, text, ...side, lane: "import" });
    if (answer.source === "") return [`${file} is not a mechanism file (.yaml), nor of another format that can be read`];
    bench.open(`${file.replace(/\.[^.]*$/, "")}.yaml`, answer.text);
    return answer.notes;
  } catch (error) {
    if (!(error instanceof AskingError)) throw error;
    return [error.fault.status === 404 ? `${file} is no mechanism file (.yaml)` : error.fault.message];
  }
}

export function save(bench: Workbench): void {
  if (!bench.nothing) download(bench.state.file, bench.state.text, "application/yaml");
}

/** A button that lets choose files; dropping some anywhere, or an address, does the same. */
export function openButton(bench: Workbench, say: (words: string[]) => void): HTMLElement {
  const input = h("input", { type: "file", id: "open-file", multiple: true, hidden: true, "aria-hidden": "true" });
  const open = async (files: Iterable<File>): Promise<void> => {
    say(await openFiles(bench, [...files]));
    input.value = "";
  };
  input.addEventListener("change", () => void open([...(input.files ?? [])]));
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    const dropped = event.dataTransfer;
    const address = dropped?.getData("text/plain").trim() ?? "";
    if (dropped && dropped.files.length > 0) void open([...dropped.files]);
    else if (/^https?:/.test(address)) void openForeign(bench, "dropped", address).then(say);
  });
  return h("span", {}, h("button", { type: "button", title: "Open a mechanism file, or drop it on the page (Ctrl+O)", click: () => input.click() }, "Open"), input);
}
