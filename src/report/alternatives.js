"use strict";
(() => {
  const motions = JSON.parse(document.getElementById("motions").textContent);
  const pairs = [...document.querySelectorAll("svg")].map((svg, i) => ({ gears: svg.querySelectorAll(".gear"), motion: motions[i] }));
  const secondsATurn = 8;
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  const pose = (turns) => {
    for (const { gears, motion } of pairs) {
      const { psi } = motion;
      const at = (turns % motion.turns) / motion.turns * (psi.length - 1);
      const i = Math.min(Math.floor(at), psi.length - 2);
      const follower = psi[i] + (at - i) * (psi[i + 1] - psi[i]);
      gears[0].setAttribute("transform", `rotate(${360 * turns})`);
      gears[1].setAttribute("transform", `rotate(${-360 * follower})`);
    }
  };
  const frame = (time) => {
    if (!still.matches) pose(time / 1000 / secondsATurn);
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
})();
