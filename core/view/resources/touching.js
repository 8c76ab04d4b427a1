// Who touches, and who is nearest, among the pairs of links that need a check.

class ContactPanel {
  constructor(world) {
    this.world = world;
  }

  show() {
    const { world } = this, { model, robot } = world, nearest = find("nearest"), list = find("pairs");
    const some = world.count() > 0 && model.links.filter((link) => link.length > 0).length > 1;
    find("touching").hidden = !some || robot.freedoms.length === 0;
    const { found } = model;
    if (!found) {
      nearest.textContent = "Finding the pairs of links that never need a check …";
      list.replaceChildren();
      return;
    }
    const names = (a, b) => `${robot.links[a].name} – ${robot.links[b].name}`;
    find("touching").dataset.pairs = found.touching.length;
    nearest.textContent = !found.nearest ? "No pair of links needs a check."
      : found.touching.length > 0 ? `${counted(found.touching.length, "pair")} of links ${found.touching.length === 1
        ? "touches" : "touch"}:` : `Nearest: ${names(found.nearest.a, found.nearest.b)}, ${millimetres(found.nearest.distance)}`;
    list.replaceChildren(...found.touching.slice(0, 30).map(({ a, b, distance }) =>
      node("li", {}, `${names(a, b)}, ${millimetres(-distance)} deep`)),
    ...(found.touching.length > 30 ? [node("li", {}, `and ${found.touching.length - 30} more`)] : []));
  }
}
