// Where a recording is played: pause, step, speed, place.
const element = (id) => document.getElementById(id);
let playing = true, scrubbing = false;

export async function post(path, text) {
  const answer = await fetch(path, { method: "POST", body: text });
  if (!answer.ok) throw new Error(await answer.text());
}

const command = (text) => post("player", text).catch((error) => console.log("player:", error.message));

function timeText(seconds) {
  return Math.floor(seconds / 60) + ":" + (seconds % 60).toFixed(1).padStart(4, "0");
}

export function connectPlayer() {
  element("play").onclick = () => command(playing ? "pause" : "play");
  element("step").onclick = () => command("step");
  element("speed").onchange = (event) => command("speed " + event.target.value);
  element("scrub").oninput = () => { scrubbing = true; };
  element("scrub").onchange = (event) => { scrubbing = false; command("seek " + event.target.value); };
}

export function showPlayer(player) {
  element("player").hidden = !player;
  if (!player) return;
  playing = player.playing;
  element("play").textContent = playing ? "Pause" : "Play";
  const length = Math.max(player.length, player.position);
  element("scrub").max = length;
  if (!scrubbing) element("scrub").value = player.position;
  element("place").textContent = timeText(player.position) + " / " + timeText(length);
}
