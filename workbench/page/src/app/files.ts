// Opening and saving: by a button, by dropping a file, by Ctrl+S. Other programs' files are read by the program.
import { ask, AskingError } from "./asking";
import { download, h } from "./dom";
import type { Workbench } from "./workbench";

interface Imported {
  text: string;
  notes: string[];
}

const longest = 4 << 20; // bytes; the program reads no more either

function toBase64(bytes: Uint8Array): string {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}

/** Its own format as it is; what came of another one, with notes. */
export async function openFile(bench: Workbench, file: File): Promise<string[]> {
  if (file.size > longest) return [`${file.name} has more than 4 MB`];
  if (/\.ya?ml$/i.test(file.name)) {
    const text = await file.text();
    if (text.trim() === "") return [`${file.name} is empty`];
    bench.open(file.name, text);
    return [];
  }
  try {
    const bytes = new Uint8Array(await file.arrayBuffer());
    const answer = await ask<Imported>("import", { file: file.name, base64: toBase64(bytes), lane: "import" });
    bench.open(`${file.name.replace(/\.[^.]*$/, "")}.yaml`, answer.text);
    return answer.notes;
  } catch (error) {
    if (!(error instanceof AskingError)) throw error;
    return [error.fault.status === 404 ? `${file.name} is no mechanism file (.yaml)` : error.fault.message];
  }
}

export function save(bench: Workbench): void {
  if (!bench.nothing) download(bench.state.file, bench.state.text, "application/yaml");
}

/** A button that lets choose a file; dropping one anywhere does the same. */
export function openButton(bench: Workbench, say: (words: string[]) => void): HTMLElement {
  const input = h("input", { type: "file", id: "open-file", hidden: true, "aria-hidden": "true" });
  const open = async (file: File | undefined): Promise<void> => {
    if (file) say(await openFile(bench, file));
    input.value = "";
  };
  input.addEventListener("change", () => void open(input.files?.[0]));
  document.addEventListener("dragover", (event) => event.preventDefault());
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    void open(event.dataTransfer?.files[0]);
  });
  return h("span", {}, h("button", { type: "button", title: "Open a mechanism file, or drop it on the page (Ctrl+O)", click: () => input.click() }, "Open"), input);
}
