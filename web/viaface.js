// The page talks HTTP alone: /v1/voices, /v1/talkers, /v1/viapoints and /v1/videos.

const $ = (id) => document.getElementById(id);
const secondsShown = 3; // of the curve, around the moment being played
const video = $("video"), curve = $("curve");
let track = null; // the answer of /v1/viapoints that belongs to the video

async function ask(path, options) {
  const answer = await fetch(path, options);
  if (answer.ok) return answer;
  const problem = await answer.json().catch(() => ({ title: answer.statusText }));
  throw new Error(problem.detail || problem.title);
}

const post = (path, body, signal) =>
  ask(path, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body), signal });

function fill(select, names, chosen) {
  for (const name of names) select.add(new Option(name, name, name === chosen, name === chosen));
}

// Plays a fragmented MP4 while it is being made; browsers without Media Source Extensions get it whole.
async function play(answer) {
  const type = answer.headers.get("Content-Type");
  if (!window.MediaSource || !MediaSource.isTypeSupported(type)) {
    video.src = URL.createObjectURL(await answer.blob());
    return video.play();
  }
  const source = new MediaSource();
  video.src = URL.createObjectURL(source);
  await once(source, "sourceopen");
  const buffer = source.addSourceBuffer(type);
  const reader = answer.body.getReader();
  let started = null;
  for (let piece = await reader.read(); !piece.done; piece = await reader.read()) {
    buffer.appendBuffer(piece.value);
    await once(buffer, "updateend");
    started ??= video.play();
  }
  source.endOfStream();
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

async function speak(event) {
  event.preventDefault();
  const said = { text: $("text").value, voice: $("voice").value, talker: $("talker").value };
  $("speak").disabled = true;
  $("message").className = "";
  $("message").textContent = "Speaking …";
  try {
    track = await (await post("/v1/viapoints", said)).json();
    $("result").hidden = false;
    await play(await post("/v1/videos", { ...said, view: { yaw: Number($("view").value) } }));
    $("message").textContent = "";
  } catch (error) {
    $("message").className = "error";
    $("message").textContent = error.message;
  } finally {
    $("speak").disabled = false;
  }
}

async function start() {
  try {
    const [voices, talkers] = await Promise.all(["/v1/voices", "/v1/talkers"].map(async (path) => (await ask(path)).json()));
    fill($("voice"), voices.voices.map((voice) => voice.name), voices.default);
    fill($("talker"), talkers.talkers.map((talker) => talker.name), talkers.default);
    $("request").addEventListener("submit", speak);
    $("speak").disabled = false;
    follow();
  } catch (error) {
    $("message").className = "error";
    $("message").textContent = error.message;
  }
}

start();
