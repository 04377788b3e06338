// Ask a CASPER domain from JavaScript: node examples/client.mjs [DOMAIN]
// The server is a child process; requests and answers are JSON-RPC 2.0, one object a line.
import { spawn } from "node:child_process";
import { createInterface } from "node:readline";

class Casper {
  #waiting = new Map();
  #last = 0;

  constructor(domain, command = process.env.CASPER ?? "casper") {
    this.process = spawn(command, ["serve", domain], { stdio: ["pipe", "pipe", "inherit"] });
    createInterface({ input: this.process.stdout }).on("line", (line) => this.#answer(JSON.parse(line)));
  }

  // A promise of the result; a mistake rejects it with the server's sentence.
  call(method, params = {}) {
    const id = ++this.#last;
    this.process.stdin.write(JSON.stringify({ jsonrpc: "2.0", id, method, params }) + "\n");
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }

  #answer({ id, result, error }) {
    const { resolve, reject } = this.#waiting.get(id);
    this.#waiting.delete(id);
    error ? reject(new Error(error.message)) : resolve(result);
  }

  end() {
    this.process.stdin.end();
  }
}

const casper = new Casper(process.argv[2] ?? "kitchen");
console.log("washing is for the robot:", await casper.call("ask", ["wash(tiago, plate, sink)"]));
console.log("eating is not:", (await casper.call("why_not", ["eat(tiago, meal, plate)"])).join("; "));

const seen = await casper.call("observe", { action: "pick_and_place(meal, hobs)" });
console.log("the goal is", seen.outcome, "with", seen.posterior);
const plan = await casper.call("plan_for", { agent: "tiago" });
console.log("tiago waits for", plan.waiting.join(", "), "and will then", plan.actions.join(", then "));
await casper.call("ask", ["wahs(tiago, plate, sink)"]).catch((mistake) => console.log("a mistake:", mistake.message));
casper.end();
