// The changed mechanism file, and every export of its loci, zones and verdict.
import { ask, AskingError } from "./asking";
import { download, h, replace, section } from "./dom";
import type { Panel } from "./panels";
import type { Workbench } from "./workbench";

interface Files {
  files: { name: string; base64: string }[];
}

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}

export function downloadPanel(bench: Workbench): Panel {
  const fault = h("div", { class: "fault", role: "alert" });
  const body = h("div", {});
  const fetchFiles = async (what: string, format: string): Promise<void> => {
    fault.textContent = "";
    const { task } = bench.state;
    try {
      const answer = await ask<Files>("export", {
        ...bench.lociQuestion(), what, format, with_loci: true, lane: `export${what}${format}`,
        ...(what === "verification" && task ? { task: bench.taskFile(task) } : {}),
      });
      for (const one of answer.files) download(one.name, bytesOf(one.base64), "application/octet-stream");
    } catch (error) {
      if (!(error instanceof AskingError)) throw error;
      fault.textContent = error.fault.message;
    }
  };
  const fetchConstructed = async (): Promise<void> => {
    fault.textContent = "";
    const { file } = bench.state;
    try {
      const answer = await ask<{ text: string; notes: string[] }>("normalize", { ...bench.lociQuestion(), lane: "normalize" });
      download(`constructed_${file}`, answer.text, "application/yaml");
    } catch (error) {
      if (!(error instanceof AskingError)) throw error;
      fault.textContent = error.fault.message;
    }
  };
  let shown = "";
  const update = (): void => {
    const { facts } = bench;
    const isDrawn = /^drawn:/m.test(bench.state.text);
    const now = JSON.stringify([facts?.formats, bench.state.task !== undefined, isDrawn]);
    if (!facts || now === shown) return;
    shown = now;
    const rows: [string, string, string[]][] = [["loci", "Loci", facts.formats.loci]];
    if (bench.overTwoLengths) rows.push(["zones", "Zones", facts.formats.zones]);
    if (bench.state.task) rows.push(["verification", "Verdict", bench.overTwoLengths ? facts.formats.verification : ["json"]]);
    replace(
      body,
      h("div", { class: "buttons" }, h("button", { type: "button", id: "download-model", click: () => download(bench.state.file, bench.state.text, "application/yaml") }, "Mechanism file"), isDrawn ? h("button", { type: "button", id: "download-constructed", click: () => void fetchConstructed() }, "With constructions") : undefined),
      ...rows.map(([what, words, formats]) => h("div", { class: "buttons" }, h("span", {}, words), ...formats.map((format) => h("button", { type: "button", "data-export": `${what}-${format}`, click: () => void fetchFiles(what, format) }, format)))),
    );
  };
  return { element: section("Download", false, h("p", { class: "quiet" }, "The mechanism file keeps its comments."), body, fault), update: (news) => (news.has("model") || news.has("state")) && update() };
}
