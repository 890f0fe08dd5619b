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

function draw() {
  if (!track) return;
  const pen = curve.getContext("2d"), { width, height } = curve;
  const top = 34, now = video.currentTime, first = Math.max(0, Math.min(now - secondsShown / 2, track.duration_s - secondsShown));
  const x = (t) => ((t - first) / secondsShown) * width;
  const opening = track.lip_opening, most = Math.max(12, ...opening.mm);
  const y = (mm) => height - 14 - ((height - top - 24) * Math.max(0, mm)) / most;
  const ink = getComputedStyle(document.body).color;
  pen.clearRect(0, 0, width, height);
  pen.font = "22px system-ui";
  pen.textAlign = "center";
  for (const phone of track.phones) {
    if (phone.end_s < first || phone.begin_s > first + secondsShown) continue;
    const spoken = phone.begin_s <= now && now < phone.end_s;
    pen.fillStyle = spoken ? "#2b59c3" : ink;
    pen.globalAlpha = spoken ? 1 : 0.65;
    if (phone.phone !== "pau") pen.fillText(phone.phone, x((phone.begin_s + phone.end_s) / 2), 24);
    pen.globalAlpha = 0.2;
    pen.fillRect(x(phone.begin_s), top, 1, height - top);
  }
  pen.globalAlpha = 1;
  pen.strokeStyle = "#c2185b";
  pen.lineWidth = 3;
  pen.beginPath();
  opening.mm.forEach((mm, i) => pen.lineTo(x(i / opening.rate_hz), y(mm)));
  pen.stroke();
  pen.fillStyle = "#2b59c3";
  pen.fillRect(x(now) - 1, top, 3, height - top);
  const phone = phoneAt(now);
  const mm = opening.mm[Math.min(opening.mm.length - 1, Math.round(now * opening.rate_hz))];
  $("now").textContent = `${now.toFixed(2)} s  ${phone ? `/${phone.ipa}/` : ""}  ${Math.max(0, mm).toFixed(1)} mm`;
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
    follow();
  } catch (error) {
    $("message").className = "error";
    $("message").textContent = error.message;
  }
}

start();
