// Replays a script of calls, made by the native kernel together with its answers, on lekalo.wasm: every answer
// must be the same bytes.
//
//   node replay.mjs lekalo.wasm SCRIPT-PROGRAM     (LEKALO_CASES sets how many sessions)
import { spawn } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { loadKernel } from './wasm_kernel.mjs';

const [wasmPath, program] = process.argv.slice(2);
const kernel = await loadKernel(readFileSync(wasmPath));

const counts = new Map();
let calls = 0,
  bytes = 0;

function replay(head, input, text, numbers) {
  const { result, text: ourText, numbers: ourNumbers } = kernel.call(head.f, head.a, input);
  ++calls;
  bytes += text.length + numbers.length;
  counts.set(head.f, (counts.get(head.f) ?? 0) + 1);
  if (result === head.r && Buffer.compare(ourText, text) === 0 && Buffer.compare(ourNumbers, numbers) === 0) return;
  const doubles = (b) => [...new Float64Array(new Uint8Array(b).buffer)].join(' ');
  console.error(`call ${calls}, ${head.f}(${head.a.join(', ')}):
  native ${head.r} ${text.subarray(0, 2000)} [${doubles(numbers)}]
  wasm   ${result} ${ourText.subarray(0, 2000)} [${doubles(ourNumbers)}]`);
  process.exit(1);
}

// A record: one line of JSON that says how many bytes of input, text and numbers follow it.
const child = spawn(program, [], { stdio: ['ignore', 'pipe', 'inherit'] });
let rest = Buffer.alloc(0);
child.stdout.on('data', (chunk) => {
  rest = rest.length === 0 ? chunk : Buffer.concat([rest, chunk]);
  for (;;) {
    const end = rest.indexOf(10);
    if (end < 0) return;
    const head = JSON.parse(rest.toString('utf8', 0, end));
    const total = end + 1 + head.input + head.text + head.numbers;
    if (rest.length < total) return;
    const input = rest.subarray(end + 1, end + 1 + head.input);
    const text = rest.subarray(end + 1 + head.input, total - head.numbers);
    replay(head, input, text, rest.subarray(total - head.numbers, total));
    rest = rest.subarray(total);
  }
});
const status = await new Promise((done) => child.on('close', done));
if (status !== 0 || rest.length !== 0 || calls === 0) {
  console.error(`the native program ended with ${status}, ${rest.length} bytes were left, ${calls} calls replayed`);
  process.exit(1);
}
const list = [...counts].map(([name, count]) => `${name.replace('lekalo_', '')} ${count}`).join(', ');
console.log(`${calls} calls alike, ${bytes} bytes of answers compared: ${list}`);
