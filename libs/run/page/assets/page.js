import { Scene } from "./scene.js";
import { readForEver } from "./stream.js";
import { show, showWord } from "./panel.js";
import { connectChoice, connectTheme } from "./choice.js";
import { connectPlayer, post, showPlayer } from "./player.js";

const element = (id) => document.getElementById(id);

function connectMark() {
  const button = element("mark"), usual = button.textContent;
  button.onclick = async () => {
    button.disabled = true;
    try {
      await post("mark", "marked on the page");
      button.textContent = "Marked";
    } catch (error) {
      button.textContent = "Not marked: " + error.message;
    }
    setTimeout(() => { button.textContent = usual; button.disabled = false; }, 1500);
  };
}

function connectStatus() {
  const events = new EventSource("status");
  let ended = false;
  events.onmessage = (event) => {
    const status = JSON.parse(event.data);
    ended = status.word === "ENDED";
    show(status);
    showPlayer(status.player);
  };
  events.onerror = () => {
    if (!ended) showWord("NO CONNECTION", "the program does not answer, or too many pages are open");
    if (events.readyState === EventSource.CLOSED) setTimeout(connectStatus, 2000);
  };
}

/** Null where nothing can be drawn: a driver still wants to read LOST. */
function openScene() {
  try { return new Scene(element("canvas")); } catch (error) {
    console.log("map:", error.message);
    element("no_map").hidden = false;
    return null;
  }
}

const scene = openScene();
connectTheme((theme) => { if (scene) scene.setTheme(theme); });
connectChoice("camera", "follow", (mode) => { if (scene) scene.setCamera(mode); });
connectChoice("colour", "height", (mode) => { if (scene) scene.setColour(mode); });
connectMark();
connectPlayer();
connectStatus();
if (scene) readForEver(scene);
