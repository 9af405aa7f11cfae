#include "app/study_report.h"

#include <fmt/format.h>

#include <cmath>

namespace softreel::app {
namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.5 "DejaVu Sans", Helvetica, Arial, sans-serif; color: #222; margin: 2em auto; max-width: 1100px; padding: 0 1em; overflow-wrap: anywhere; }
h1 { font-size: 1.5em; margin-bottom: 0.2em; } h2 { font-size: 1.15em; margin-top: 2em; }
pre { background: #f4f5f6; padding: 0.8em 1em; border-radius: 4px; white-space: pre-wrap; font-size: 13px; }
svg { max-width: 100%; height: auto; }
.table { overflow-x: auto; } table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; }
th, td { padding: 0.25em 0.7em; border-bottom: 1px solid #e3e3e3; text-align: right; white-space: nowrap; }
th:first-child, td:first-child, td.why { text-align: left; } td.why { white-space: normal; min-width: 18em; color: #a33; }
th { cursor: pointer; border-bottom: 2px solid #999; position: sticky; top: 0; background: #fff; user-select: none; }
th[aria-sort=ascending]::after { content: " \25b2"; } th[aria-sort=descending]::after { content: " \25bc"; }
tr.now td { background: #fff7dc; } tr.failed td { color: #a33; } tr:hover td { background: #eef4fb; }
figure { display: inline-block; margin: 0 1.5em 1em 0; } figcaption { font-size: 13px; color: #555; max-width: 320px; }
.warning { background: #fdf0ec; border-left: 4px solid #d55e00; padding: 0.5em 1em; }
)";

constexpr const char* kScript = R"(
document.querySelectorAll('th').forEach(function (head, column) {
  head.addEventListener('click', function () {
    var body = document.querySelector('tbody'), rows = Array.from(body.rows);
    var up = head.getAttribute('aria-sort') !== 'ascending';
    document.querySelectorAll('th').forEach(function (other) { other.removeAttribute('aria-sort'); });
    head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
    rows.sort(function (a, b) {
      var x = a.cells[column].dataset.value, y = b.cells[column].dataset.value;
      if (x === '' || y === '') return (x === '') - (y === '');
      var n = x - y;
      return (up ? 1 : -1) * (isNaN(n) ? x.localeCompare(y) : n);
    });
    rows.forEach(function (row) { body.appendChild(row); });
  });
});
)";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

/// From <svg on: what stands before it has no place inside HTML.
std::string inline_svg(const std::string& svg) {
  const size_t start = svg.find("<svg");
  return start == std::string::npos ? std::string() : svg.substr(start);
}

std::string cell(const std::string& shown, const std::string& value, const char* kind = "") {
  return fmt::format("<td{} data-value=\"{}\">{}</td>", kind, escaped(value), escaped(shown));
}
std::string cell(double value, const char* unit = "") {
  if (!std::isfinite(value)) return cell("beyond the picture", "1e300");
  return cell(fmt::format("{:.3g}{}", value, unit), fmt::format("{:.9g}", value));
}
std::string cell(const std::optional<double>& value) { return value ? cell(*value) : cell("", ""); }

std::string row_html(const StudyRow& r, double size) {
  std::string html = fmt::format("<tr{}>", r.present ? " class=\"now\"" : r.done() ? "" : " class=\"failed\"");
  html += cell(r.label + (r.present ? " (the scene now)" : ""), r.label);
  html += r.run ? cell(r.wall) : cell("", "");
  if (r.errors) {
    html += cell(r.errors->worst) + cell(100 * r.errors->worst / size) + cell(r.errors->end) + cell(r.errors->clip) +
            cell(r.errors->largest) + cell(r.errors->largest_px);
  } else {
    for (int i = 0; i < 6; ++i) html += cell("", "");
  }
  const Drifts& d = r.drifts;
  for (const auto& v : {d.energy, d.momentum, d.angular, d.volume, d.penetration, d.pins}) html += cell(v);
  html += r.run ? cell(r.processor) : cell("", "");
  for (const double v : {r.stages.gradient, r.stages.assemble, r.stages.solve, r.stages.contact, r.stages.other()})
    html += r.run ? cell(v) : cell("", "");
  for (const long v : {r.steps, r.newton, r.linear, r.retries})
    html += r.run ? cell(fmt::format("{}", v), fmt::format("{}", v)) : cell("", "");
  html += r.run ? cell(static_cast<double>(r.peak_memory) / 1048576) : cell("", "");
  std::string why;
  if (r.failure)
    why = r.run && r.failure->step > 0 ? fmt::format("{} at t = {:.4g} s, step {}: {}", r.status(), r.failure->time,
                                                     r.failure->step, r.failure->why)
                                       : fmt::format("{}: {}", r.status(), r.failure->why);
  return html + cell(why, why, " class=\"why\"") + "</tr>\n";
}

}  // namespace

std::string study_html(const StudyReport& report, const std::vector<StudyRow>& rows, const StudyReference& reference) {
  const StudyHead& h = report.head;
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Study of {0}</title>\n"
      "<meta name=\"viewport\" content=\"width=device-width\"><style>{1}</style></head><body>\n"
      "<h1>Error against run time: {0}</h1>\n<pre>{2}</pre>\n",
      escaped(h.scene), kStyle, escaped(report.lines));
  if (!h.warning.empty()) html += fmt::format("<p class=\"warning\">{}</p>\n", escaped(h.warning));
  html += fmt::format(
      "<p>Measured against {}, whose own error is {}. The scene is {:.3g} m across.</p>\n", escaped(reference.what),
      reference.floor > 0 ? fmt::format("about {:.2g} m: nothing below it can be read off", reference.floor)
                          : "that of rounding",
      reference.size);
  for (const std::string& plot : report.plots) html += inline_svg(plot) + "\n";
  if (!report.pictures.empty()) html += "<h2>The last frame</h2>\n";
  for (const ReportPicture& p : report.pictures)
    html += fmt::format(
        "<figure><img alt=\"{0}\" src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
        escaped(p.caption), base64(p.png));
  html +=
      "<h2>All runs</h2>\n<p>A click on a head sorts. RMS: over all points of a frame.</p>\n<div class=\"table\">"
      "<table><thead><tr>";
  for (const char* head :
       {"settings",        "wall [s]",     "worst RMS [m]", "of size [%]",  "end RMS [m]",  "clip RMS [m]",
        "largest [m]",     "largest [px]", "energy drift",  "momentum",     "angular m.",   "volume",
        "penetration [m]", "pins [m]",     "processor [s]", "gradient [s]", "assemble [s]", "solve [s]",
        "contact [s]",     "other [s]",    "steps",         "Newton",       "linear",       "retried",
        "memory [MiB]",    "failure"})
    html += fmt::format("<th>{}</th>", head);
  html += "</tr></thead><tbody>\n";
  for (const StudyRow& r : rows) html += row_html(r, reference.size);
  html += fmt::format(
      "</tbody></table></div>\n<h2>How it was made</h2>\n<pre>{}\n\n{}\n{} in use, budget {:.6g} s\n\n{}</pre>\n",
      escaped(h.command), escaped(h.machine), h.threads, h.budget, escaped(h.versions));
  return html + fmt::format("<script>{}</script></body></html>\n", kScript);
}

}  // namespace softreel::app
