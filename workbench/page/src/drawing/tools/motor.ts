import { toggleMotor } from "../edit";
import type { Tool } from "./tool";

export const motorTool: Tool = {
  id: "motor",
  label: "Motor",
  key: "m",
  hint: "Click on a joint: adds a motor, or removes it",
  icon: "M12 5 a7 7 0 1 0 .1 0 M9 15 V9 L12 13 L15 9 V15",
  takes: "place",
  act: ({ drawing, to, element }) => {
    if (element?.kind === "joint") return toggleMotor(drawing, element.name);
    const joints = drawing.joints.filter((one) => one.at === to.point && ["revolute", "prismatic", "cylindrical"].includes(one.type));
    const joint = joints.find((one) => one.actuated) ?? joints.find((one) => one.from === "ground") ?? joints[0];
    return joint && toggleMotor(drawing, joint.name);
  },
};
