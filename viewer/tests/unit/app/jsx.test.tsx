// @vitest-environment jsdom
import { render } from "preact";
import { expect, test } from "vitest";

test("JSX renders with Preact", () => {
  render(<b>x</b>, document.body);
  expect(document.body.innerHTML).toBe("<b>x</b>");
});
