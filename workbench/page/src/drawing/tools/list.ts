// All tools, in the order of the toolbar.
import { beltTool } from "./belt";
import { cableTool } from "./cable";
import { cylinderTool } from "./cylinder";
import { endEffectorTool } from "./end_effector";
import { forceTool } from "./force";
import { freeTool } from "./free";
import { gearTool } from "./gear";
import { groundPinTool } from "./ground_pin";
import { linkTool } from "./link";
import { massTool } from "./mass";
import { motorTool } from "./motor";
import { pinTool } from "./pin";
import { plateTool } from "./plate";
import { removeTool } from "./remove";
import { selectTool } from "./select";
import { sliderTool } from "./slider";
import { slotTool } from "./slot";
import { springTool } from "./spring";
import type { Tool } from "./tool";
import { workspaceTool } from "./workspace";

export const tools: readonly Tool[] = [
  selectTool,
  groundPinTool,
  linkTool,
  plateTool,
  pinTool,
  sliderTool,
  slotTool,
  cylinderTool,
  gearTool,
  beltTool,
  motorTool,
  springTool,
  cableTool,
  forceTool,
  massTool,
  endEffectorTool,
  freeTool,
  workspaceTool,
  removeTool,
];
