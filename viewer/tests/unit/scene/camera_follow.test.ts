import { expect, test } from "vitest";

import { looking } from "../../../src/scene/camera";
import { CameraFollow } from "../../../src/scene/camera_follow";
import { kDefaultCamera } from "../../../src/scene/state";

const front = looking(kDefaultCamera, "front");
const top = looking(kDefaultCamera, "top");

test("the camera follows the result it was put for, until it is moved", () => {
  const follow = new CameraFollow();
  expect(follow.follows("r1", front)).toBe(false);
  follow.put("r1", front);
  expect(follow.follows("r1", { ...front })).toBe(true);
  expect(follow.follows("r2", front)).toBe(false);
  expect(follow.follows("r1", top)).toBe(false);
  expect(follow.followed(front)).toBe("r1");
  expect(follow.followed(top)).toBeNull();
  follow.put("r2", top);
  expect(follow.follows("r1", top)).toBe(false);
  expect(follow.follows("r2", top)).toBe(true);
});
