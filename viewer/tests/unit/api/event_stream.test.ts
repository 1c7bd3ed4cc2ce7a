import { expect, test } from "vitest";
import { readEvents, type ServerEvent } from "../../../src/api/event_stream";

function streamOf(...pieces: string[]): ReadableStream<Uint8Array> {
  const encoder = new TextEncoder();
  return new ReadableStream({
    start(controller) {
      for (const piece of pieces) controller.enqueue(encoder.encode(piece));
      controller.close();
    },
  });
}

async function eventsOf(...pieces: string[]): Promise<ServerEvent[]> {
  const events: ServerEvent[] = [];
  for await (const event of readEvents(streamOf(...pieces))) events.push(event);
  return events;
}

test("events are divided at empty lines, wherever the pieces end", async () => {
  const text = 'event: started\ndata: {"id":"q-1"}\n\nevent: result\ndata: {"value":1}\n\n';
  const expected = [
    { event: "started", data: '{"id":"q-1"}' },
    { event: "result", data: '{"value":1}' },
  ];
  expect(await eventsOf(text)).toEqual(expected);
  expect(await eventsOf(...Array.from(text))).toEqual(expected);
});

test("CRLF line ends, divided between the two characters", async () => {
  expect(await eventsOf("data: a\r", "\n\r\n")).toEqual([{ event: "message", data: "a" }]);
});

test("several data lines are joined, comments are skipped", async () => {
  expect(await eventsOf(": keep alive\n\ndata: a\ndata: b\n\n")).toEqual([
    { event: "message", data: "a\nb" },
  ]);
});

test("an event that is cut off is dropped", async () => {
  expect(await eventsOf("event: result\ndata: {}\n")).toEqual([]);
});
