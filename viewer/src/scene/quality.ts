/**
 * How finely frames are drawn. At rest: fully. While something moves, the resolution is lowered as long as frames
 * take longer than they should, and then coarser levels of detail are taken.
 */

/** A frame should not take longer, in milliseconds. */
export const kFrameGoal = 33;
const kComfort = 20;
const kScales = [1, 0.8, 0.65, 0.5, 0.4] as const;
/** Frames that are looked at before a step. */
const kWindow = 4;

export class Quality {
  private step: number;
  private coarse = false;
  private times: number[] = [];

  constructor(software: boolean) {
    this.step = software ? 2 : 0;
  }

  /** Resolution while moving, as a factor. */
  get scale(): number {
    return kScales[this.step]!;
  }

  /** Coarser levels are drawn while moving. */
  get isCoarse(): boolean {
    return this.coarse;
  }

  /** The time between two frames of one movement. Returns whether something was changed. */
  observe(milliseconds: number, coarseWouldHelp: boolean): boolean {
    this.times.push(Math.min(milliseconds, 500));
    if (this.times.length < kWindow) return false;
    const median = [...this.times].sort((a, b) => a - b)[Math.floor(kWindow / 2)]!;
    this.times = [];
    if (median > kFrameGoal) {
      // Far too slow: triangles are the reason rather than pixels.
      if ((median > 3 * kFrameGoal || this.step === kScales.length - 1) && coarseWouldHelp && !this.coarse) {
        this.coarse = true;
        return true;
      }
      if (this.step === kScales.length - 1) return false;
      this.step++;
      return true;
    }
    if (median < kComfort && this.step > 0) {
      this.step--;
      return true;
    }
    return false;
  }

  /** What is shown has changed much: fine levels get another chance. */
  reset(): void {
    this.coarse = false;
    this.times = [];
  }

  /** A movement ended; the time until the next one does not count. */
  pause(): void {
    this.times = [];
  }
}
