// The state as the part of an address after #: JSON, deflated, in base64 that addresses bear.
import { freshState, noDemands, type State } from "./state";

async function through(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream): Promise<Uint8Array> {
  const piped = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

function toBase64(bytes: Uint8Array): string {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text.replace(/-/g, "+").replace(/_/g, "/"));
  return Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
}

export async function toHash(state: State): Promise<string> {
  const bytes = new TextEncoder().encode(JSON.stringify({ v: 1, ...state }));
  return `#${toBase64(await through(bytes, new CompressionStream("deflate-raw")))}`;
}

/** Nothing where the address holds no state, or one that is damaged. */
export async function fromHash(hash: string): Promise<State | undefined> {
  if (hash.length < 2) return undefined;
  try {
    const bytes = await through(fromBase64(hash.slice(1)), new DecompressionStream("deflate-raw"));
    const value: unknown = JSON.parse(new TextDecoder().decode(bytes));
    if (!(value instanceof Object) || !("text" in value) || typeof value.text !== "string") return undefined;
    const { v, ...rest } = value as Partial<State> & { v?: number; text: string };
    if (v !== 1) return undefined;
    const task = rest.task && { ...noDemands, ...rest.task }; // links of earlier versions demand less
    return { ...freshState("model.yaml", ""), ...rest, task };
  } catch {
    return undefined;
  }
}
