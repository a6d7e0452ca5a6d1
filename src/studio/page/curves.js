// Closed curves as flat lists x0, y0, x1, y1, ...

export const pathOf = (flat) => {
  const path = new Path2D();
  for (let i = 0; i < flat.length; i += 2) path[i ? "lineTo" : "moveTo"](flat[i], flat[i + 1]);
  path.closePath();
  return path;
};

// The greatest distance from the origin.
export const reach = (flat) => {
  let most = 0;
  for (let i = 0; i < flat.length; i += 2) most = Math.max(most, Math.hypot(flat[i], flat[i + 1]));
  return most;
};
