// What a drawing lacks before there is anything to ask the program: one line, at the element concerned.
import { isGround, type Drawing } from "./drawing";
import type { Element } from "./element";

export interface Missing {
  words: string;
  element?: Element;
}

/** Of what has constructions, or copies of a pattern, the program alone says it. */
export function missingIn(drawing: Drawing): Missing | undefined {
  if (/^(points|repeat):/m.test(drawing.text)) return undefined;
  const { links, joints, points } = drawing;
  if (points.length === 0) return { words: "Draw a ground pin or a link: press at one end, release at the other" };
  const [still] = points;
  if (links.length === 0) return { words: `Draw a link from ${still?.name ?? "the pin"}`, ...(still ? { element: { kind: "point", name: still.name } } : {}) };
  const loose = links.find((link) => !joints.some((joint) => joint.from === link.name || joint.to === link.name));
  if (loose) return { words: `Link ${loose.name} has no joint: begin or end a link at one of its points`, element: { kind: "link", name: loose.name } };
  if (!joints.some((joint) => joint.from === "ground" || joint.to === "ground")) return { words: "No link is connected to the ground: put a ground pin at the end of one", ...(links[0] ? { element: { kind: "link", name: links[0].name } } : {}) };
  if (!joints.some((joint) => joint.actuated) && !drawing.ties.some((tie) => tie.type === "cable")) return { words: "No motor: put one at a joint", ...(joints[0] ? { element: { kind: "joint", name: (joints.find((joint) => joint.from === "ground") ?? joints[0]).name } } : {}) };
  if (!drawing.endEffector) {
    const free = points.find((point) => !isGround(drawing, point.name));
    return { words: "No end effector: draw a force at its point, or mark it with the tool End effector", ...(free ? { element: { kind: "point", name: free.name } } : {}) };
  }
  if (drawing.coordinates.length === 0) return { words: "No free coordinate: draw the workspace box, or choose the angle of a link with the tool Free coordinate" };
  return undefined;
}
