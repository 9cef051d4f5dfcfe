// A stand-in for the server in tests of the page: it keeps placements, moves and removes them, counts revisions.
// `compact` is long: `onTheWay` tells how far it is, `endLong` ends it.
// It checks nothing: `refuse` says which commands it refuses, `violations` what a preview answers.

export class ServerDouble {
  constructor(document, { refuse = () => null, violations = () => [] } = {}) {
    this.long = null;
    this.stopped = [];
    this.document = structuredClone(document);
    this.placements = new Map((document.placements ?? []).map((p) => [p.id, p]));
    this.revision = 1;
    this.done = [];
    this.undone = [];
    this.refuse = refuse;
    this.violations = violations;
    this.lines = [];
  }
  get nextId() {
    return Math.max(0, ...this.placements.keys()) + 1;
  }
  hello() {
    return {
      type: 'layout',
      client: 2,
      revision: this.revision,
      name: this.document.name ?? 'test',
      document: { ...this.document, placements: [...this.placements.values()], next_id: this.nextId },
    };
  }
  /** Answers to a message, in order. */
  answer(text) {
    const m = JSON.parse(text);
    if (m.type === 'select') return [];
    if (m.type === 'stop') {
      this.stopped.push(m.seq);
      return [];
    }
    if (m.type === 'preview')
      return [{ type: 'preview', seq: m.seq, placements: this.plan(m.text), violations: this.violations(m.text) }];
    this.lines.push(m.text ?? m.type);
    if (m.type === 'command') {
      if (m.text.startsWith('compact ')) {
        this.long = m;
        return [];
      }
      const message = this.refuse(m.text, m.mode);
      if (message) return [{ type: 'refused', seq: m.seq, message, violations: [] }];
      const changes = this.plan(m.text);
      if (changes.length === 0) return [{ type: 'done', seq: m.seq, revision: this.revision, nothing: true }];
      const before = changes.map(({ id }) => ({ id, after: this.placements.get(id) ?? null }));
      this.done.push({ before, after: changes });
      return this.carryOut(m, changes, 'command');
    }
    const [from, to] = m.type === 'undo' ? [this.done, this.undone] : [this.undone, this.done];
    const step = from.pop();
    if (!step) return [{ type: 'refused', seq: m.seq, message: `nothing to ${m.type}`, violations: [] }];
    to.push(step);
    return this.carryOut(m, m.type === 'undo' ? step.before : step.after, m.type);
  }
  /** The messages of a long command on its way. */
  onTheWay(fraction, secondsLeft, placements) {
    const { seq } = this.long;
    return [
      { type: 'progress', seq, fraction, seconds_left: secondsLeft },
      ...(placements ? [{ type: 'improved', seq, placements }] : []),
    ];
  }
  /** The long command has ended with these changes, early if it was stopped. */
  endLong(changes) {
    const m = this.long;
    this.long = null;
    const answers = this.carryOut(m, changes, 'command');
    if (this.stopped.includes(m.seq)) answers[0].stopped = true;
    return answers;
  }
  carryOut(m, changes, kind) {
    for (const { id, after } of changes) {
      if (after) this.placements.set(id, after);
      else this.placements.delete(id);
    }
    this.revision += 1;
    return [
      { type: 'done', seq: m.seq, revision: this.revision },
      {
        type: 'change',
        revision: this.revision,
        client: 2,
        text: m.text ?? '',
        kind,
        placements: changes,
        next_id: this.nextId,
      },
    ];
  }
  plan(line) {
    const [verb, ids, ...rest] = line.split(' ');
    const chosen = (ids ?? '')
      .split(',')
      .map((id) => this.placements.get(Number(id)))
      .filter(Boolean);
    if (verb === 'remove') return chosen.map((p) => ({ id: p.id, after: null }));
    if (verb === 'move')
      return chosen.map((p) => ({ id: p.id, after: { ...p, x: p.x + Number(rest[1]), y: p.y + Number(rest[2]) } }));
    return [];
  }
}
