// Colours that both viewers share: Viridis (Smith and van der Walt, 2015), and the hues of Okabe and Ito (2008).
"use strict";

const VIRIDIS = ["#440154", "#443983", "#31688e", "#21918c", "#35b779", "#90d743", "#fde725"];
const HUES = ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#b8a800", "#7a6fd0"];
const GREY = [0.72, 0.74, 0.77];

/// Red, green and blue, 0 to 1, of "#rrggbb".
const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);

/// The colour of a share of the scale, 0 to 1.
const viridis = (t) => {
  const at = Math.min(Math.max(t, 0), 1) * (VIRIDIS.length - 1), i = Math.min(Math.floor(at), VIRIDIS.length - 2);
  const [low, high] = [rgb(VIRIDIS[i]), rgb(VIRIDIS[i + 1])];
  return low.map((x, k) => x + (at - i) * (high[k] - x));
};
