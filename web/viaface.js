// The page talks HTTP alone: /v1/voices, /v1/talkers, /v1/viapoints and /v1/videos.

const $ = (id) => document.getElementById(id);
const secondsShown = 3; // of the curve, around the moment being played
const video = $("video"), curve = $("curve");
// The stream's own profiles; the level is the highest, as it depends on the size.
const streamType = 'video/mp4; codecs="avc1.640034, mp4a.40.2"';
let track = null; // the answer of /v1/viapoints that belongs to the video
let underway = null; // the AbortController of what is being asked for

async function inWords(answer) {
  const problem = await answer.json().catch(() => ({}));
  if (answer.status === 503) return `The service is busy; try again in ${answer.headers.get("Retry-After") || "some"} seconds.`;
  if (problem.field) return `${problem.field}: “${problem.value}” cannot be used. Allowed: ${problem.allowed}.`;
  return problem.detail || `The service answered ${answer.status}.`;
}

async function ask(path, options) {
  const answer = await fetch(path, options).catch((error) => {
    throw error.name === "AbortError" ? error : new Error("The service does not answer.");
  });
  if (!answer.ok) throw new Error(await inWords(answer));
  return answer;
}

const post = (path, body, signal) =>
  ask(path, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body), signal });

function fill(select, names, chosen) {
  for (const name of names) select.add(new Option(name, name, name === chosen, name === chosen));
}

// Plays a fragmented MP4 while it is being made; browsers without Media Source Extensions get it whole.
async function play(answer) {
  if (!window.MediaSource || !MediaSource.isTypeSupported(streamType)) {
    video.src = URL.createObjectURL(await answer.blob());
    return video.play();
  }
  const source = new MediaSource();
  video.src = URL.createObjectURL(source);
  await once(source, "sourceopen");
  URL.revokeObjectURL(video.src);
  const buffer = source.addSourceBuffer(streamType);
  const reader = answer.body.getReader();
  let started = null;
  try {
    for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
      buffer.appendBuffer(piece.value);
      await once(buffer, "updateend");
      started ??= video.play();
    }
  } catch (error) {
    throw error.name === "AbortError" ? error : new Error("The film broke off before its end.");
  } finally {
    if (source.readyState === "open") source.endOfStream();
  }
  return started;
}

const once = (target, event) => new Promise((done) => target.addEventListener(event, done, { once: true }));

function phoneAt(time) {
  return track.phones.find((phone) => phone.begin_s <= time && time < phone.end_s);
}

// Pixels of the canvas are those of the screen; drawing is in CSS pixels.
function sizedPen() {
  const ratio = window.devicePixelRatio || 1, width = curve.clientWidth, height = curve.clientHeight;
  if (curve.width !== Math.round(width * ratio)) curve.width = Math.round(width * ratio);
  if (curve.height !== Math.round(height * ratio)) curve.height = Math.round(height * ratio);
  const pen = curve.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return { pen, width, height };
}

function draw() {
  if (!track) return;
  const { pen, width, height } = sizedPen();
  const left = 46, top = 36, bottom = height - 24, now = video.currentTime;
  const shown = Math.min(secondsShown, (width - left) / 120); // 120 pixels a second keep the labels apart
  const first = Math.max(0, Math.min(now - shown / 2, track.duration_s - shown));
  const x = (t) => left + ((t - first) / shown) * (width - left);
  const opening = track.lip_opening, most = Math.max(15, ...opening.mm);
  const y = (mm) => bottom - ((bottom - top) * Math.max(0, mm)) / most;
  const style = getComputedStyle(curve), ink = style.color, accent = style.getPropertyValue("--accent");
  const seen = (part) => part.end_s > first && part.begin_s < first + shown;
  const isNow = (part) => part.begin_s <= now && now < part.end_s;

  pen.textBaseline = "middle";
  pen.font = "11px system-ui, sans-serif";
  pen.textAlign = "right";
  pen.fillStyle = ink;
  for (let mm = 0; mm < most; mm += 5) {
    pen.globalAlpha = 0.7;
    pen.fillText(mm === 0 ? "0 mm" : mm, left - 5, y(mm));
    pen.globalAlpha = 0.15;
    pen.fillRect(left, y(mm), width - left, 1);
  }

  pen.save();
  pen.beginPath();
  pen.rect(left, 0, width - left, height);
  pen.clip();
  pen.textAlign = "center";
  track.phones.forEach((phone, i) => {
    if (!seen(phone)) return;
    pen.globalAlpha = 0.15;
    pen.fillStyle = ink;
    pen.fillRect(x(phone.begin_s), top - 4, 1, bottom - top + 4);
    if (phone.phone === "pau") return;
    pen.globalAlpha = isNow(phone) ? 1 : 0.7;
    pen.fillStyle = isNow(phone) ? accent : ink;
    pen.font = `${isNow(phone) ? "bold " : ""}15px system-ui, sans-serif`;
    pen.fillText(phone.ipa, x((phone.begin_s + phone.end_s) / 2), i % 2 ? 8 : 23); // two rows: neighbours stay apart
  });
  pen.font = "13px system-ui, sans-serif";
  for (const word of track.words.filter(seen)) {
    pen.globalAlpha = isNow(word) ? 1 : 0.7;
    pen.fillStyle = isNow(word) ? accent : ink;
    pen.fillText(word.text, x((word.begin_s + word.end_s) / 2), height - 9);
  }
  pen.globalAlpha = 1;
  pen.strokeStyle = style.getPropertyValue("--curve");
  pen.lineWidth = 2;
  pen.lineJoin = "round";
  pen.beginPath();
  opening.mm.forEach((mm, i) => pen.lineTo(x(i / opening.rate_hz), y(mm)));
  pen.stroke();
  pen.fillStyle = accent;
  pen.fillRect(x(now) - 1, top - 4, 2, bottom - top + 4);
  pen.restore();

  const phone = phoneAt(now);
  const mm = opening.mm[Math.min(opening.mm.length - 1, Math.round(now * opening.rate_hz))];
  $("now").textContent = `${now.toFixed(2)} s  ${phone && phone.phone !== "pau" ? `/${phone.ipa}/` : "pause"}  ${Math.max(0, mm).toFixed(1)} mm`;
}

function follow() {
  draw();
  requestAnimationFrame(follow);
}

function tell(text, wrong = false) {
  $("message").className = wrong ? "error" : "";
  $("message").textContent = text;
}

// A new request ends the one underway: the service stops its work when the connection closes.
async function speak(event) {
  event.preventDefault();
  underway?.abort();
  const mine = (underway = new AbortController());
  const said = { text: $("text").value, voice: $("voice").value, talker: $("talker").value };
  $("stop").hidden = false;
  $("text").removeAttribute("aria-invalid");
  tell("Speaking …");
  try {
    const answer = await (await post("/v1/viapoints", said, mine.signal)).json();
    const film = await post("/v1/videos", { ...said, view: { yaw: Number($("view").value) } }, mine.signal);
    track = answer;
    $("result").hidden = false;
    await play(film);
    if (underway === mine) tell("");
  } catch (error) {
    if (underway !== mine || error.name === "AbortError") return;
    tell(error.message, true);
    if (error.message.startsWith("text")) {
      $("text").setAttribute("aria-invalid", "true");
      $("text").focus();
    }
  } finally {
    if (underway === mine) {
      underway = null;
      $("stop").hidden = true;
    }
  }
}

function stop() {
  underway?.abort();
  underway = null;
  video.pause();
  $("stop").hidden = true;
  $("speak").focus();
  tell("Stopped.");
}

async function start() {
  try {
    const [voices, talkers] = await Promise.all(["/v1/voices", "/v1/talkers"].map(async (path) => (await ask(path)).json()));
    fill($("voice"), voices.voices.map((voice) => voice.name), voices.default);
    fill($("talker"), talkers.talkers.map((talker) => talker.name), talkers.default);
    const takeOwnVoice = () => {
      const talker = talkers.talkers.find(({ name }) => name === $("talker").value);
      $("voice").value = talker.voice ?? voices.default;
      $("talker").title = talker.summary;
    };
    $("talker").addEventListener("change", takeOwnVoice);
    takeOwnVoice();
    $("request").addEventListener("submit", speak);
    $("stop").addEventListener("click", stop);
    $("text").addEventListener("keydown", (event) => {
      if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) $("request").requestSubmit();
    });
    $("speak").disabled = false;
    follow();
  } catch (error) {
    tell(error.message, true);
  }
}

start();
