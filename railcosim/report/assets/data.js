"use strict";

/** What the page shows. */
const report = JSON.parse(document.getElementById("data").textContent);

/** The number behind a packed array: float32, least significant byte first, in base64. */
const unpack = ({ bdata }) => {
  const bytes = Uint8Array.from(atob(bdata), (character) => character.charCodeAt(0));
  return new Float32Array(bytes.buffer);
};

/** A colour of a figure as it is on the present page. */
const shade = (colour) => (theme.isDark() ? (report.dark[colour] ?? colour) : colour);
