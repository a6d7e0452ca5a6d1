// Numbers as people type and read them.

// A number from text with a decimal point or a decimal comma; NaN where there is none.
export const read = (text) => {
  let plain = String(text).trim().replace(/[\s\u00a0']/g, "").replace("−", "-");
  plain = plain.replace(/(mm|°|×|modules|rpm|nmm)$/i, "");
  const [comma, point] = [plain.lastIndexOf(","), plain.lastIndexOf(".")];
  if (comma >= 0 && point >= 0) {
    // Where both stand, the last one is the decimal sign.
    plain = comma > point ? plain.replace(/\./g, "").replace(",", ".") : plain.replace(/,/g, "");
  } else {
    plain = plain.replace(",", ".");
  }
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
};

// Without noise of binary fractions, and with as many places as the step has.
export const written = (value, step = 0.01) => {
  const places = Math.max(0, Math.min(6, Math.ceil(-Math.log10(step) - 1e-9)));
  const text = Number(value).toFixed(places);
  return places ? text.replace(/0+$/, "").replace(/\.$/, "") : text;
};

export const shown = (value, places = 2) => {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = value.toFixed(places);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
};

export const degrees = (radians) => (radians * 180) / Math.PI;
export const radians = (deg) => (deg * Math.PI) / 180;
export const clamp = (value, low, high) => Math.min(high, Math.max(low, value));
