// Questions to the server. Of those that follow the hand only the newest counts: a question is asked when the one before
// is answered, or has taken so long that the server is told to abandon it.

export interface Fault {
  status: number;
  message: string;
  line: number;
  column: number;
}

export class AskingError extends Error {
  constructor(readonly fault: Fault) {
    super(fault.message);
  }
}

export const client = Math.random().toString(36).slice(2, 12);

/** `onFirst`: what is told of a first part of the answer, which comes ahead of the rest. */
export async function ask<T>(question: string, body: object, onFirst?: (part: object) => void): Promise<T> {
  let response: Response;
  try {
    response = await fetch(`api/${question}`, {
      method: "POST",
      headers: { "Content-Type": "application/json" },
      body: JSON.stringify({ ...body, client, quiet: true, ...(onFirst ? { parts: true } : {}) }),
    });
  } catch {
    throw new AskingError({ status: 0, message: "the program has ended: start clearloci view again", line: 0, column: 0 });
  }
  const inParts = response.headers.get("Content-Type") === "application/x-ndjson" && onFirst;
  const answer = (inParts ? await lastPart(response, onFirst) : await response.json()) as Record<string, unknown>;
  // What a hand may write wrongly is no failure of the page: browsers would put each 4xx on the console.
  const refused = typeof answer["refused"] === "number" ? answer["refused"] : undefined;
  if (response.ok && refused === undefined) return answer as T;
  throw new AskingError({
    status: refused ?? response.status,
    message: typeof answer["error"] === "string" ? answer["error"] : "the question was not answered",
    line: Number(answer["line"] ?? 0),
    column: Number(answer["column"] ?? 0),
  });
}

/** Of an answer in lines each that comes ahead goes to `onFirst`; the last is the answer. */
async function lastPart(response: Response, onFirst: (part: object) => void): Promise<unknown> {
  const reader = response.body?.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (let read = await reader?.read(); read && !read.done; read = await reader?.read()) {
    text += read.value;
    for (let end = text.indexOf("\n"); end >= 0; end = text.indexOf("\n")) {
      onFirst(JSON.parse(text.slice(0, end)) as object);
      text = text.slice(end + 1);
    }
  }
  return JSON.parse(text);
}

/** Of questions whose answers begin with a first part. */
export interface FirstPart {
  /** What the server needs for it, as things are when the question is sent. */
  from: () => object;
  onFirst: (part: object, made: number) => void;
}

const patience = 400; // ms, after which newer work takes the place of older

export class Following<T> {
  private asked = 0;
  private answered = 0;
  private waiting: { body: object; made: number } | undefined;
  private since = 0;
  private inFlight = "";
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    private readonly question: string,
    private readonly onAnswer: (answer: T, made: number, question: object) => void,
    private readonly onFault: (fault: Fault) => void,
    private readonly first?: FirstPart,
  ) {}

  /** `made`: when the hand moved. */
  want(body: object, made = performance.now()): void {
    const running = this.asked !== this.answered;
    if (running && JSON.stringify(body) === this.inFlight) {
      this.waiting = undefined; // what is being worked on is what is wanted
      return;
    }
    this.waiting = { body, made };
    if (!running || performance.now() - this.since > patience) this.send();
    else this.timer ??= setTimeout(() => this.late(), patience);
  }

  get busy(): boolean {
    return this.asked !== this.answered || this.waiting !== undefined;
  }

  forget(): void {
    this.waiting = undefined;
    this.answered = this.asked;
  }

  private late(): void {
    this.timer = undefined;
    if (this.waiting) this.send();
  }

  private send(): void {
    const next = this.waiting;
    if (!next) return;
    this.waiting = undefined;
    if (this.timer !== undefined) clearTimeout(this.timer);
    this.timer = undefined;
    const number = ++this.asked;
    this.inFlight = JSON.stringify(next.body);
    this.since = performance.now();
    const finish = (then: () => void): void => {
      if (number <= this.answered) return; // a newer one was answered already
      this.answered = number;
      then();
      if (this.waiting && this.asked === this.answered) this.send();
    };
    const { first } = this;
    const onFirst = first && ((part: object): void => {
      if (number === this.asked && number > this.answered) first.onFirst(part, next.made);
    });
    ask<T>(this.question, { ...next.body, ...first?.from() }, onFirst).then(
      (answer) => finish(() => this.onAnswer(answer, next.made, next.body)),
      (error: unknown) =>
        finish(() => {
          if (error instanceof AskingError) {
            if (error.fault.status !== 409) this.onFault(error.fault);
          } else {
            throw error;
          }
        }),
    );
  }
}
