/** Round numbers for grids and scales. */

/** The smallest of 1, 2, 5 times a power of ten that is not below `length`. Domain: positive. */
export function roundStep(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  for (const factor of [1, 2, 5, 10]) {
    if (factor * power >= length * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

/** A coordinate that is a multiple of `step`, without digits below the step. */
export function formatStep(value: number, step: number): string {
  if (Math.abs(value) < step / 2) return "0";
  if (Math.abs(value) >= 1e7 || step < 1e-6) {
    const digits = Math.ceil(Math.log10(Math.abs(value) / step)) + 1;
    return String(Number(value.toPrecision(Math.min(17, Math.max(1, digits)))));
  }
  const digits = Math.max(0, Math.min(20, -Math.floor(Math.log10(step * 1.0000001))));
  return value.toFixed(digits);
}

/** The multiples of `step` from min to max, at most `limit` of them. */
export function multiples(min: number, max: number, step: number, limit: number): number[] {
  const values: number[] = [];
  for (let i = Math.ceil(min / step - 1e-9); i * step <= max + step * 1e-9 && values.length < limit; i++) {
    values.push(i * step);
  }
  return values;
}
