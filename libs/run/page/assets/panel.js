// The words and numbers at the side.
import { kLidarColours } from "./map.js";

const element = (id) => document.getElementById(id);

function make(tag, text, name) {
  const made = document.createElement(tag);
  if (text !== undefined) made.textContent = text;
  if (name) made.className = name;
  return made;
}

function bytesText(bytes) {
  if (bytes >= 1e12) return (bytes / 1e12).toFixed(2) + " TB";
  return bytes >= 1e9 ? (bytes / 1e9).toFixed(1) + " GB" : (bytes / 1e6).toFixed(0) + " MB";
}

function timeText(seconds) {
  const whole = Math.round(seconds);
  if (whole < 60) return seconds.toFixed(1) + " s";
  return Math.floor(whole / 60) + ":" + String(whole % 60).padStart(2, "0") + " min";
}

/** Null as long as nothing is wrong with the lidar's window. */
function windowFault(lidar) {
  if (!(lidar.returns < 0.6 * lidar.usual_returns)) return null;
  const usually = Math.round(100 * lidar.usual_returns);
  return make("div", "window dirty or covered? usually " + usually + " % return", "fault");
}

function lidarCard(lidar, index, played) {
  const card = make("div", undefined, "sensor"), head = make("header"), dot = make("span", "", "dot");
  dot.style.background = kLidarColours[index % kLidarColours.length];
  head.append(dot, make("b", lidar.name), make("span", lidar.model, "model"));
  const received = make("div"), columns = make("div"), fault = windowFault(lidar);
  received.append(lidar.silent ? make("span", "silent for " + timeText(lidar.silence), "fault")
                            : "seen " + timeText(lidar.silence) + " ago");
  if (!played) received.append(", " + Math.round(lidar.rate) + " packets/s");
  columns.append(lidar.lost + " columns lost" + (lidar.left_out ? ", " + lidar.left_out + " too late" : ""));
  if (lidar.usual_returns > 0) columns.append(", " + Math.round(100 * lidar.returns) + " % return");
  card.append(head, received, columns);
  if (fault) card.append(fault);
  if (lidar.clock_offset !== null) card.append(make("div", "clock offset " + offsetText(lidar.clock_offset)));
  return card;
}

/** What is added to the lidar's stamps: of microseconds, or of the years between two clocks' epochs. */
function offsetText(seconds) {
  const size = Math.abs(seconds), sign = seconds < 0 ? "\u2212" : "+";
  if (size < 1) return sign + (1e3 * size).toFixed(3) + " ms";
  return sign + size.toFixed(3) + " s";
}

function imuRow(imu) {
  const said = imu.silence > 1 ? make("span", "silent for " + timeText(imu.silence), "fault")
                               : Math.round(imu.rate) + " samples/s";
  return [imu.name, said];
}

function rowsOf(pairs) {
  return pairs.flatMap(([name, value]) => {
    const term = make("dt", name), said = make("dd");
    said.append(value);
    return [term, said];
  });
}

function runRows(status) {
  const rows = [];
  if (status.factor !== undefined) rows.push(["real-time factor", status.factor.toFixed(1)]);
  if (status.poses) {
    rows.push(["path", status.distance.toFixed(1) + " m"], ["speed", status.speed.toFixed(1) + " m/s"],
              ["keyframes", status.keyframes]);
    if (status.keyframes_left_out) rows.push(["keyframes not drawn", status.keyframes_left_out]);
  }
  rows.push(["recorded", timeText(status.recorded)], ["scans", status.scans]);
  rows.push(["disk left", bytesText(status.disk_free)], ["memory", bytesText(status.memory)]);
  return rows;
}

function why(status) {
  const silent = status.lidars.filter((lidar) => lidar.silent).map((lidar) => "'" + lidar.name + "' sends nothing");
  return silent.concat(status.why ? [status.why] : []).join("; ");
}

function warningRow(warning) {
  const row = make("li", warning.text + " ");
  const times = warning.count > 1 ? warning.count + " times, " : "";
  row.append(make("small", "(" + times + timeText(warning.age) + " ago)"));
  return row;
}

function markRow(mark) {
  const row = make("li", mark.text + " ");
  row.append(make("small", "(at " + timeText(mark.after) + ")"));
  return row;
}

export function showWord(word, reason) {
  element("health").dataset.word = word;
  element("word").textContent = word;
  element("why").textContent = reason;
  document.title = word + " - scanloom";
}

export function show(status) {
  showWord(status.word, why(status));
  element("lidars").replaceChildren(...status.lidars.map((lidar, i) => lidarCard(lidar, i, Boolean(status.player))));
  element("imus").replaceChildren(...(status.imus.length ? rowsOf(status.imus.map(imuRow)) : [make("dt", "none")]));
  element("run").replaceChildren(...rowsOf(runRows(status)));
  const warnings = status.warnings.map(warningRow);
  element("warnings").replaceChildren(...(warnings.length ? warnings : [make("li", "none")]));
  element("marked").hidden = status.marks === 0;
  element("marks").replaceChildren(...status.newest_marks.map(markRow));
  element("mark").hidden = Boolean(status.player) || status.word === "ENDED";
}
