#include "host/report/page_parts.hpp"

namespace fencepost::host {

const std::string_view kStylesheet = R"css(
:root { color-scheme: light; --ink: #1c2733; --soft: #5a6775; --rule: #dfe4e9; --paper: #fff; --ground: #f4f6f8; }
* { box-sizing: border-box; }
body { margin: 0; overflow-wrap: anywhere; background: var(--ground); color: var(--ink); line-height: 1.45;
  font: 15px/1.45 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1080px; margin: 0 auto; padding: 28px 20px 40px; }
header { margin-bottom: 18px; }
h1 { font-size: 25px; line-height: 1.2; margin: 0; overflow-wrap: anywhere; }
h2 { font-size: 17px; margin: 0 0 12px; }
header p { margin: 4px 0 0; color: var(--soft); }
section { background: var(--paper); border: 1px solid var(--rule); border-radius: 8px; padding: 16px 18px; margin: 0 0 16px; }
code { font: 13px/1 ui-monospace, "SF Mono", Menlo, Consolas, monospace; }
.note { color: var(--soft); font-size: 13.5px; margin: 8px 0 0; min-height: 1.45em; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(124px, 1fr)); margin: 0 0 16px;
  background: var(--paper); border: 1px solid var(--rule); border-radius: 8px; overflow: hidden; }
.figures div { box-shadow: 0 0 0 .5px var(--rule); padding: 10px 14px; display: flex; flex-direction: column-reverse; }
.figures dt { color: var(--soft); font-size: 13px; }
.figures dd { margin: 0; font-size: 21px; font-weight: 600; font-variant-numeric: tabular-nums; white-space: nowrap; }
.figures small { font-size: 14px; font-weight: 400; color: var(--soft); }
.map { position: relative; display: flex; flex-wrap: wrap; align-items: center; gap: 4px 0; }
.map > input { position: absolute; opacity: 0; }
.map > label { display: inline-flex; align-items: center; gap: 8px; margin-right: 22px; padding: 3px 0; cursor: pointer;
  white-space: nowrap; }
.map > label::before { content: ""; width: 15px; height: 15px; border: 1.5px solid #5a6775; border-radius: 3px;
  background: #fff; line-height: 13px; font-size: 13px; font-weight: 700; color: #fff; text-align: center; }
.map > input:checked + label::before { content: "\2713"; background: #334155; border-color: #334155; }
.map > input:focus-visible + label { outline: 2px solid #1d6fd8; outline-offset: 3px; border-radius: 3px; }
.map > label svg { flex: none; overflow: visible; }
.figure { width: 100%; overflow-x: auto; }
.figure svg { display: block; width: 100%; min-width: 620px; height: auto; }
svg text { font: 14px system-ui, -apple-system, "Segoe UI", Roboto, Arial, sans-serif; fill: var(--soft);
  font-variant-numeric: tabular-nums; }
svg .rule { stroke: #e6eaee; stroke-width: 1; fill: none; }
svg .zero { stroke: #c3cbd3; stroke-width: 1.2; }
svg .border { fill: none; stroke: #b4bec8; }
svg .axis { stroke: #1c2733; stroke-width: 1.8; }
svg .tip { fill: #1c2733; }
svg .origin text { font-weight: 600; fill: #1c2733; }
svg .scale path { fill: none; stroke: #1c2733; stroke-width: 1.6; }
svg .scale text { fill: #1c2733; }
svg .footprint { fill: url(#hatch); stroke: #6b7683; stroke-width: 1.2; }
svg .track { fill: none; stroke: #3b4a5c; stroke-width: 1.7; stroke-linejoin: round; }
svg .tick { fill: none; stroke: #3b4a5c; stroke-width: 1.5; stroke-linejoin: round; stroke-linecap: round; }
svg .mark { fill: #3b4a5c; }
svg .start { fill: #fff; stroke: #3b4a5c; stroke-width: 2.2; }
svg .robot { fill: #3b4a5c; }
svg .layer-path text, svg .labels text, svg .nearest { paint-order: stroke; stroke: #fff; stroke-width: 3.5px;
  stroke-linejoin: round; }
svg .labels text { font-weight: 600; }
svg .leader { fill: none; stroke: #5a6775; stroke-width: 1; }
svg .labels .layer-truth { font-weight: 400; }
svg .nearest { fill: var(--ink); }
svg text.name { font-weight: 600; }
svg path.is-tentative { opacity: .4; }
svg path.is-lost { opacity: .7; }
svg path.open { fill: none; stroke: #fff; stroke-dasharray: 4 4; }
svg text.is-tentative, svg text.is-lost { font-style: italic; font-weight: 400; }
svg .curve { fill: none; stroke: #3b4a5c; stroke-width: 1.4; }
svg .dots circle { stroke: #3b4a5c; stroke-width: .8; }
.levels { display: flex; flex-wrap: wrap; gap: 4px 20px; margin: 0 0 8px; font-size: 14px; }
.levels span { display: inline-flex; align-items: center; gap: 7px; }
.levels i, .swatch { display: inline-block; width: 14px; height: 14px; border-radius: 3px; border: 1px solid rgba(0,0,0,.35); }
.levels .line { width: 22px; border-top: 2px solid #3b4a5c; }
.swatch { margin-right: 8px; vertical-align: -2px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: 14px; }
th { text-align: left; font-weight: 600; color: var(--soft); font-size: 13px; vertical-align: bottom; }
th small { display: block; font-weight: 400; font-size: 12px; }
th, td { padding: 6px 9px; border-bottom: 1px solid var(--rule); white-space: nowrap; }
td.name { white-space: normal; overflow-wrap: anywhere; min-width: 9em; }
tbody tr:last-child td { border-bottom: 0; }
td { font-variant-numeric: tabular-nums; }
.n { text-align: right; }
.c { text-align: center; }
table.counts { width: auto; }
.level { display: inline-block; min-width: 52px; padding: 1px 8px; border-radius: 3px; text-align: center; background: #e9edf1; }
.level.notice { background: #f6d365; }
.level.warn { background: #e8871e; color: #000; }
.level.stop { background: #b1122a; color: #fff; }
.level.blind { background: #5b2a86; color: #fff; }
details { margin-top: 12px; }
summary { cursor: pointer; color: var(--soft); }
details ul { margin: 8px 0 0; padding-left: 22px; }
footer { color: var(--soft); font-size: 13px; }
@media (max-width: 640px) {
  main { padding: 18px 10px 28px; }
  section { padding: 12px; }
  h1 { font-size: 21px; }
}
@media print {
  body { background: #fff; font-size: 12px; }
  main { max-width: none; padding: 0; }
  section, tr { break-inside: avoid; }
  section { border: 0; padding: 0; }
  .figure svg { min-width: 0; }
  .map > label::before { display: none; }
  .scroll, .figure { overflow: visible; }
  table { font-size: 10px; }
  th, td { white-space: normal; overflow-wrap: anywhere; padding: 3px 4px; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
)css";

}  // namespace fencepost::host
