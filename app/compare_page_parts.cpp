#include "app/compare_page_parts.h"

namespace softreel::app {

const char* const kComparePageStyle = R"(
body { font: 15px/1.5 "DejaVu Sans", Helvetica, Arial, sans-serif; color: #222; margin: 1.5em auto; max-width: 1500px; padding: 0 1em; }
h1 { font-size: 1.3em; overflow-wrap: anywhere; border-left: 8px solid #2a7; padding-left: 0.5em; } .bad h1 { border-color: #c33; }
h2 { font-size: 1.1em; margin: 1.5em 0 0.3em; overflow-wrap: anywhere; }
pre { background: #f4f5f6; padding: 0.7em 1em; border-radius: 4px; font-size: 13px; white-space: pre-wrap; overflow-wrap: anywhere; }
#curve { width: 100%; height: 190px; cursor: crosshair; background: #fafbfc; border: 1px solid #ddd; display: block; }
#curve text { font-size: 12px; fill: #555; } #cursor { stroke: #222; stroke-dasharray: 3 3; }
.mean { stroke: #0072b2; fill: none; stroke-width: 2; } .flip { stroke: #cc79a7; fill: none; stroke-width: 2; } .flicker { stroke: #e69f00; fill: none; stroke-width: 1.5; }
circle { fill: #c33; }
#bar { display: flex; flex-wrap: wrap; gap: 0.5em; align-items: center; margin: 0.5em 0; }
button { font: inherit; padding: 0.15em 0.8em; border: 1px solid #aaa; border-radius: 4px; background: #fff; cursor: pointer; }
button[aria-pressed=true] { background: #222; color: #fff; }
#side { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); gap: 0.5em; }
figure { margin: 0; } figcaption { font-size: 13px; color: #555; }
#views img { max-width: 100%; height: auto; display: block; background: repeating-conic-gradient(#ddd 0 25%, #fff 0 50%) 0 0 / 16px 16px; }
#views.pixels img { image-rendering: pixelated; width: 100%; }
#over { position: relative; width: fit-content; max-width: 100%; } #views.pixels #over { width: 100%; }
#top { position: absolute; left: 0; top: 0; width: 100%; height: 100%; overflow: hidden; }
#split { position: absolute; top: 0; bottom: 0; width: 2px; background: #fff; mix-blend-mode: difference; pointer-events: none; }
#slider { width: 100%; } [hidden] { display: none !important; }
#names { max-height: 22em; overflow-y: auto; border: 1px solid #ddd; }
#names div { padding: 0.1em 0.6em; cursor: pointer; font-size: 13px; overflow-wrap: anywhere; border-left: 4px solid #2a7; }
#names div.bad { border-color: #c33; } #names div.now { background: #fff3c4; } #names div:hover { background: #eef4fb; }
table { border-collapse: collapse; font-size: 13px; table-layout: fixed; width: 100%; } td, th { padding: 0.15em 0.7em; border-bottom: 1px solid #e3e3e3; text-align: left; overflow-wrap: anywhere; }
tr.other td { background: #fdf0ec; } kbd { border: 1px solid #aaa; border-radius: 3px; padding: 0 0.3em; font-size: 12px; }
)";

const char* const kComparePageBody = R"(
<svg id="curve" role="img" aria-label="difference over time"></svg>
<h2 id="name"></h2><pre id="text"></pre>
<div id="bar">
<button id="mode-side">side by side</button><button id="mode-slider">slider</button><button id="mode-blink">blink</button>
<button id="previous">&#9664;</button><button id="next">&#9654;</button><button id="pixels">pixels</button>
<span><kbd>&larr;</kbd> <kbd>&rarr;</kbd> frame in time, <kbd>&uarr;</kbd> <kbd>&darr;</kbd> by how bad, <kbd>Home</kbd> worst, <kbd>1</kbd> side by side, <kbd>2</kbd> slider, <kbd>3</kbd> blink, <kbd>,</kbd> <kbd>.</kbd> move the slider, <kbd>Space</kbd> the other picture, <kbd>p</kbd> pixels</span>
</div>
<p id="none" hidden>The pictures of this frame are not in this page: --report-pictures N puts more of them in.</p>
<div id="views">
<div id="side">
<figure id="f-reference"><figcaption>reference</figcaption></figure>
<figure id="f-actual"><figcaption>actual</figcaption></figure>
<figure id="f-difference"><figcaption>difference: dark red 1 level, yellow to white 64 and more</figcaption></figure>
</div>
<div id="overlay" hidden><p id="shown"></p><div id="over"><div id="under"></div><div id="top"></div><div id="split"></div></div>
<input id="slider" type="range" min="0" max="100" value="50" aria-label="how much of the actual picture is shown"></div>
</div>
<h2>Frames, the worst first</h2><div id="names"></div>
<h2>What the pictures say of themselves</h2><table id="texts"><thead><tr><th>key</th><th>reference</th><th>actual</th></tr></thead><tbody></tbody></table>
)";

const char* const kComparePageScript = R"(
(function () {
  'use strict';
  var now = order[0], mode = 'side', blinkTimer = null, blinkActual = false;
  function get(id) { return document.getElementById(id); }
  function picture(uri, alt) {
    var image = document.createElement('img');
    image.alt = alt; image.src = uri;
    return image;
  }
  function fill(place, uri, alt) {
    place.querySelectorAll('img').forEach(function (old) { old.remove(); });
    place.hidden = place.tagName === 'FIGURE' && !uri;
    if (uri) place.appendChild(picture(uri, alt));
  }
  function showActual(actual) {
    blinkActual = actual;
    get('top').style.clipPath = actual ? 'none' : 'inset(0 0 0 100%)';
    get('shown').textContent = actual ? 'actual' : 'reference';
  }
  function slide() {
    var part = get('slider').value;
    get('top').style.clipPath = 'inset(0 0 0 ' + part + '%)';
    get('split').style.left = part + '%';
    get('shown').textContent = 'reference on the left, actual on the right';
  }
  function setMode(wanted) {
    var both = pictures[now] && pictures[now].reference && pictures[now].actual;
    mode = wanted;
    var shown = both ? wanted : 'side';
    if (blinkTimer) { clearInterval(blinkTimer); blinkTimer = null; }
    ['side', 'slider', 'blink'].forEach(function (m) { get('mode-' + m).setAttribute('aria-pressed', String(m === mode)); });
    get('side').hidden = shown !== 'side';
    get('overlay').hidden = shown === 'side';
    get('slider').hidden = get('split').hidden = shown !== 'slider';
    if (shown === 'slider') slide();
    if (shown === 'blink') {
      showActual(false);
      blinkTimer = setInterval(function () { showActual(!blinkActual); }, 500);
    }
  }
  function show(index) {
    now = index;
    var frame = frames[index], p = pictures[index];
    get('name').textContent = frame.name;
    get('text').textContent = frame.text;
    get('none').hidden = Boolean(p);
    get('views').hidden = !p;
    p = p || { texts: [] };
    fill(get('f-reference'), p.reference, 'reference of ' + frame.name);
    fill(get('f-actual'), p.actual, 'actual picture of ' + frame.name);
    fill(get('f-difference'), p.difference, 'difference of ' + frame.name);
    fill(get('under'), p.reference, 'reference of ' + frame.name);
    fill(get('top'), p.actual, 'actual picture of ' + frame.name);
    var body = get('texts').tBodies[0];
    body.textContent = '';
    p.texts.forEach(function (row) {
      var line = body.insertRow();
      row.forEach(function (text) { line.insertCell().textContent = text; });
      if (row[1] !== row[2]) line.className = 'other';
    });
    document.querySelectorAll('#names div').forEach(function (line) { line.classList.toggle('now', Number(line.dataset.index) === index); });
    var cursor = get('cursor');
    if (cursor) { cursor.setAttribute('x1', xOf(index)); cursor.setAttribute('x2', xOf(index)); }
    setMode(mode);
  }
  function step(list, by) {
    var at = list.indexOf(now) + by;
    if (at >= 0 && at < list.length) show(list[at]);
  }
  var inTime = frames.map(function (_, i) { return i; });

  var kLeft = 10, kRight = 990, kTop = 30, kBottom = 170;
  function xOf(i) { return frames.length < 2 ? kLeft : kLeft + (kRight - kLeft) * i / (frames.length - 1); }
  function element(name, attributes) {
    var e = document.createElementNS('http://www.w3.org/2000/svg', name);
    Object.keys(attributes).forEach(function (key) { e.setAttribute(key, attributes[key]); });
    get('curve').appendChild(e);
    return e;
  }
  function curve(key, label, x) {
    var most = frames.reduce(function (m, f) { return Math.max(m, f[key] || 0); }, 0);
    if (!(most > 0)) return x;
    var path = '', pen = false;
    frames.forEach(function (f, i) {
      if (f[key] === null) { pen = false; return; }
      path += (pen ? 'L' : 'M') + xOf(i) + ' ' + (kBottom - (kBottom - kTop) * f[key] / most);
      pen = true;
    });
    element('path', { d: path, 'class': key, 'vector-effect': 'non-scaling-stroke' });
    element('rect', { x: x, y: 6, width: 12, height: 8, 'class': key });
    element('text', { x: x + 18, y: 14 }).textContent = label + ', up to ' + most.toPrecision(3);
    return x + 320;
  }
  if (frames.length > 1) {
    get('curve').setAttribute('viewBox', '0 0 1000 190');
    get('curve').setAttribute('preserveAspectRatio', 'none');
    var x = curve('mean', 'mean difference [levels]', kLeft);
    x = curve('flip', 'FLIP', x);
    curve('flicker', 'flicker [levels]', x);
    frames.forEach(function (f, i) {
      if (!f.good) element('circle', { cx: xOf(i), cy: kBottom + 9, r: 4 });
    });
    element('line', { id: 'cursor', y1: kTop - 8, y2: kBottom + 16, x1: 0, x2: 0, 'vector-effect': 'non-scaling-stroke' });
    get('curve').addEventListener('click', function (event) {
      var box = get('curve').getBoundingClientRect();
      var at = 1000 * (event.clientX - box.left) / box.width;
      var nearest = Math.round((at - kLeft) / (kRight - kLeft) * (frames.length - 1));
      show(Math.min(Math.max(nearest, 0), frames.length - 1));
    });
  } else {
    get('curve').remove();
  }

  order.forEach(function (i) {
    var line = document.createElement('div');
    line.textContent = frames[i].name + ': ' + frames[i].text;
    line.dataset.index = i;
    if (!frames[i].good) line.className = 'bad';
    line.addEventListener('click', function () { show(i); });
    get('names').appendChild(line);
  });
  ['side', 'slider', 'blink'].forEach(function (m) { get('mode-' + m).addEventListener('click', function () { setMode(m); }); });
  function pixels() {
    var on = get('views').classList.toggle('pixels');
    get('pixels').setAttribute('aria-pressed', String(on));
  }
  get('slider').addEventListener('input', slide);
  get('previous').addEventListener('click', function () { step(inTime, -1); });
  get('next').addEventListener('click', function () { step(inTime, 1); });
  get('pixels').addEventListener('click', pixels);
  function moveSlider(by) {
    setMode('slider');
    get('slider').value = Number(get('slider').value) + by;
    slide();
  }
  var keys = {
    ArrowLeft: function () { step(inTime, -1); }, ArrowRight: function () { step(inTime, 1); },
    ArrowUp: function () { step(order, -1); }, ArrowDown: function () { step(order, 1); },
    Home: function () { show(order[0]); },
    '1': function () { setMode('side'); }, '2': function () { setMode('slider'); }, '3': function () { setMode('blink'); },
    ',': function () { moveSlider(-5); }, '.': function () { moveSlider(5); }, p: pixels,
    ' ': function () {
      var other = !blinkActual;
      setMode('blink');
      clearInterval(blinkTimer);
      blinkTimer = null;
      showActual(other);
    }
  };
  document.addEventListener('keydown', function (event) {
    if (event.ctrlKey || event.metaKey || event.altKey || !keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });
  show(now);
})();
)";

}  // namespace softreel::app
