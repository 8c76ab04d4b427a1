// Requests to the session that serves the page, one change after the other.

class SessionLink {
  constructor(world, told) {
    Object.assign(this, { world, told, version: world.session?.version ?? 0, last: Promise.resolve() });
  }

  async ask(name, request) {
    let answer;
    try {
      answer = await fetch(name, { method: "POST", headers: { "Content-Type": "application/json" },
        body: JSON.stringify(request) });
    } catch {
      throw new Error("the session does not answer; is foam view still running?");
    }
    const json = await answer.json();
    if (!answer.ok) {
      throw new Error(json.error);
    }
    return json;
  }

  /// Makes a change, after those before it. `request(version)`. Errors are told.
  change(name, request) {
    this.last = this.last.then(async () => {
      try {
        this.told("");
        const answer = await this.ask(name, { ...request, version: this.version });
        this.took(answer);
      } catch (error) {
        this.told(error.message);
        this.world.touch("failed");
      }
    });
    return this.last;
  }

  took({ version, undo, redo, model, links }) {
    const { world } = this, of = world.models[model];
    this.version = version;
    of.changes = (of.changes ?? 0) + 1;
    Object.assign(world.session, { undo, redo });
    for (const [l, { spheres, pinned, weight, verdict }] of Object.entries(links)) {
      of.links[l] = spheres.map((row, i) => ({ kind: "sphere", row, pinned: pinned[i], protrusion: null }));
      of.weights[l] = weight;
      if (of.verdicts && verdict !== undefined) {
        of.verdicts[l] = verdict;
      } else if (verdict === undefined) {
        of.verdicts = null;
      }
    }
    if (world.selected && !world.element) {
      world.selected = null;
    }
    world.touch("edit");
    this.refresh(model);
  }

  /// Asks for what depends on the spheres, when no change has come for a while.
  refresh(model) {
    const of = this.world.models[model];
    clearTimeout(of.later);
    of.later = setTimeout(() => this.learn(model), 300);
  }

  /// Asks for proofs, where they are not known, and for the pairs that need no check.
  async learn(model) {
    const { world } = this, of = world.models[model], changes = of.changes;
    try {
      if (!of.verdicts && world.robotOf(of).judged) {
        const { verdicts } = await this.ask("proofs", { model });
        if (changes !== of.changes) {
          return;   // what changed them asks again
        }
        of.verdicts = verdicts;
        world.touch("proof");
      }
      const { ignored } = await this.ask("ignored", { model });
      if (changes === of.changes) {
        world.ignore(of, ignored);
        world.touch("pairs");
      }
      if (world.colour === "protrusion") {
        await this.protrusions(model);
        world.touch("colour");
      }
    } catch (error) {
      this.told(error.message);
    }
  }

  async protrusions(model) {
    const of = this.world.models[model], changes = of.changes;
    const { protrusions } = await this.ask("figures", { model });
    if (protrusions && changes === of.changes) {
      of.links.forEach((link, l) => link.forEach((element, i) => { element.protrusion = protrusions[l][i]; }));
    }
  }
}
