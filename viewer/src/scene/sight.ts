/** Where the camera looks: by itself at what comes first and at what would not be seen, else where a person wants it. */

import { Vector3 } from "three";
import type { Box3 } from "three";

import type { CameraState, StandardView } from "./api";
import { CameraControl, type CameraHost } from "./camera_control";
import { CameraFollow } from "./camera_follow";
import { isDotBeside, mainBox } from "./main_box";
import type { Column, ShapeRecord } from "./shape_store";
import type { Stage } from "./stage";

/** Of the height of the view: what is smaller is not seen well. */
const kLeastShare = 0.08;
/** What is seen around an object, by its size. */
const kAround = 0.5;

const kMostPast = 50;

export interface SightHost extends CameraHost {
  /** Another number of objects is left out of sight. */
  farChanged(count: number): void;
}

export class Sight {
  private readonly control: CameraControl;
  private readonly follow = new CameraFollow();
  private isSet = false;
  /** The camera is that of a link, for objects that are still to come. */
  private isRestored = false;
  private far = 0;
  /** Cameras before commands, the latest one last. */
  private readonly past: CameraState[] = [];

  constructor(
    private readonly stage: Stage,
    private readonly host: SightHost,
  ) {
    this.control = new CameraControl(host);
  }

  /** Objects that lie so far from the others that the camera did not go back for them. */
  get farCount(): number {
    return this.far;
  }

  // What is there changes ---------------------------------------------------------------------------------------------

  /** Shapes of a column have come. */
  came(column: Column, which: "first" | "more" | "finer"): void {
    if (which === "first") this.bringIn(column);
    else if (which === "more" && column.visible) this.followMore(column.source.result);
  }

  /** Moves the camera if nothing of what is new would be seen, or it is all that there is. */
  bringIn(column: Column): void {
    const { store } = this.stage;
    if (!column.visible || this.boxOf().isEmpty()) return;
    const { result } = column.source;
    if (!this.isSet) {
      this.isSet = true;
      this.control.look("isometric", this.mainBox(), false);
      this.follow.put(result, this.control.goal);
      return;
    }
    const alone = store.columns.every((other) => other.source.result === result || !other.visible);
    const own = store.box(column.records.values());
    const unseen = !this.stage.isInSight(own, this.control.goal);
    if ((!alone || this.isRestored) && !unseen) return;
    if (!alone && this.wouldHideOthers(column, own)) {
      this.setFar(this.far + column.records.size);
      return;
    }
    this.control.fit(this.mainBox());
    this.follow.put(result, this.control.goal);
  }

  /** Whether what was seen until now would become a dot in a picture that shows a new column, too. */
  private wouldHideOthers(column: Column, own: Box3): boolean {
    const { store } = this.stage;
    const others = [...store.visibleRecords()].filter((record) => record.column !== column);
    return isDotBeside(mainBox(others.map((record) => record.box())).box, own);
  }

  /** Fits again as long as the camera is where it was put for the first shapes of this result. */
  private followMore(result: string): void {
    if (!this.follow.follows(result, this.control.goal)) return;
    this.control.fit(this.mainBox());
    this.follow.put(result, this.control.goal);
  }

  /** Goes to objects, but not so near that nothing else is seen; stays where they are seen well. */
  reveal(records: readonly ShapeRecord[]): void {
    const box = this.stage.store.box(records);
    if (box.isEmpty()) return;
    const { goal } = this.control;
    const size = box.getSize(new Vector3()).length();
    const isSeen = this.stage.isInSight(box, goal) && size > kLeastShare * goal.height && size < goal.height;
    if (isSeen) return;
    this.remember();
    this.control.fit(box.clone().expandByScalar(kAround * size));
  }

  /** The same objects are drawn in other places. */
  arranged(): void {
    if (this.isSet && !this.boxOf().isEmpty()) this.control.fit(this.boxOf(), false);
  }

  /** The view has another shape: what was put into it by itself must fit again. */
  resized(): void {
    const result = this.follow.followed(this.control.goal);
    if (result === null) return;
    this.control.fit(this.mainBox(), false);
    this.follow.put(result, this.control.goal);
  }

  /** Objects were removed, hidden or shown again. */
  othersAreSeen(): void {
    if (this.stage.store.columns.length === 0) this.isSet = false;
    if (this.far > 0) this.mainBox();
  }

  // The camera was moved ----------------------------------------------------------------------------------------------

  /** By whatever: the next objects come to a view that has a camera. */
  changed(): void {
    this.isSet = true;
  }

  restored(): void {
    this.isRestored = true;
  }

  /** By a person: animations end, and the camera is no longer that of a link. */
  movedByPerson(): void {
    this.control.stop();
    this.isRestored = false;
  }

  // Commands ----------------------------------------------------------------------------------------------------------

  fit(records?: readonly ShapeRecord[]): void {
    this.remember();
    this.control.fit(this.boxOf(records));
    if (!records) this.setFar(0);
  }

  seeing(box: Box3): CameraState {
    return this.control.seeing(box);
  }

  look(view: StandardView): void {
    this.remember();
    this.control.look(view, this.boxOf());
    this.setFar(0);
  }

  /** Goes to the camera before the latest command. */
  back(): void {
    const camera = this.past.pop();
    if (camera) this.control.go(camera, true);
  }

  private remember(): void {
    this.past.push(this.control.goal);
    if (this.past.length > kMostPast) this.past.shift();
  }

  turn(axis: "roll" | "up" | "side", degrees: number): void {
    this.control.turn(axis, degrees);
  }

  go(camera: CameraState, animate: boolean): void {
    this.control.go(camera, animate);
  }

  /** Ends an animation at its goal. */
  finish(): void {
    this.control.finish();
  }

  stop(): void {
    this.control.stop();
  }

  private setFar(count: number): void {
    if (count === this.far) return;
    this.far = count;
    this.host.farChanged(count);
  }

  private mainBox(): Box3 {
    const { box, far } = mainBox([...this.stage.store.visibleRecords()].map((record) => record.box()));
    this.setFar(far);
    return box.isEmpty() ? this.boxOf() : box;
  }

  private boxOf(records?: readonly ShapeRecord[]): Box3 {
    if (records && records.length > 0) return this.stage.store.box(records);
    const box = this.stage.store.box();
    for (const addition of this.stage.additions.values()) if (box.isEmpty()) box.copy(addition.box);
    return box;
  }
}
