// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/internal/format_html.h"
#include "trysquare/report/internal/svg.h"

namespace trysquare::internal {
namespace {

constexpr const char* kColors = R"(
:root{color-scheme:light dark;--paper:#ffffff;--card:#f6f7f9;--ink:#1b2128;--soft:#5b6470;--line:#e1e5e9;
--good:#1d7a4c;--good-paper:#eef8f2;--bad:#b3261e;--bad-paper:#fdf1f0;--warn:#8f5b00;--warn-paper:#fff8e8}
@media screen and (prefers-color-scheme:dark){:root{--paper:#171b20;--card:#1e242a;--ink:#e8ecf0;--soft:#a3adb8;
--line:#2d343c;--good:#6fcf9b;--good-paper:#182a22;--bad:#ff9a90;--bad-paper:#321d1c;
--warn:#f0bf5c;--warn-paper:#2e2616}}
)";

constexpr const char* kLayout = R"(
*{box-sizing:border-box}
html{background:var(--paper);color:var(--ink);-webkit-text-size-adjust:100%}
body{margin:0 auto;max-width:1080px;padding:40px 32px 56px;font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,
"Helvetica Neue",Arial,sans-serif;overflow-wrap:anywhere}
h1,h2,h3,p{margin:0}
header .product{color:var(--soft);font-size:14px}
h1{font-size:27px;line-height:1.25;font-weight:650;letter-spacing:-.01em;margin:2px 0 4px}
h2{font-size:19px;line-height:1.3;font-weight:650;margin:0 0 14px}
h3{font-size:15px;font-weight:650}
section{margin-top:44px}
section h3{margin:24px 0 8px}
section h2+h3{margin-top:0}
.note,.reason,small,figcaption{color:var(--soft);font-weight:400}
.note{font-size:14px;margin-top:10px;max-width:72ch}
.verdict,.warning{border-left:4px solid;border-radius:4px;padding:14px 18px;margin-top:24px}
.verdict strong{font-size:19px}
.verdict ul{margin:6px 0 0;padding-left:20px}
.good{border-color:var(--good);background:var(--good-paper)}.good strong{color:var(--good)}
.bad{border-color:var(--bad);background:var(--bad-paper)}.bad strong{color:var(--bad)}
.warning{border-color:var(--warn);background:var(--warn-paper);margin-top:10px;padding:10px 18px}
.warning code{color:var(--warn);font-weight:600}
code{font:.88em/1.4 ui-monospace,SFMono-Regular,Menlo,Consolas,monospace}
.cards{display:grid;grid-template-columns:repeat(auto-fill,minmax(300px,1fr));gap:14px;margin-top:20px}
.card{background:var(--card);border-radius:6px;padding:14px 18px 16px}
.card h3{margin:0;font-size:14px}
.card small{font-size:13px;margin-left:4px}
.number{font-size:28px;line-height:1.25;font-weight:600;letter-spacing:-.01em;margin:4px 0 6px;
font-variant-numeric:tabular-nums}
.number .undefined-value{display:block;color:var(--soft);font-weight:500}
.number .reason{display:block;font-size:14px;line-height:1.45;letter-spacing:0}
.card div{font-size:14px;line-height:1.45;color:var(--soft)}
.card div b{color:var(--ink);font-weight:600}
.figures{display:grid;grid-template-columns:repeat(2,minmax(0,1fr));gap:26px 36px}
.figures.one{grid-template-columns:minmax(0,660px)}
figure{margin:0;min-width:0}
.figure{display:block;width:100%;height:auto}
.wide{overflow-x:auto;overflow-wrap:normal}
table{border-collapse:collapse;font-size:14px;font-variant-numeric:tabular-nums}
th,td{padding:6px 22px 6px 0;text-align:left;vertical-align:top;border-bottom:1px solid var(--line)}
thead th{color:var(--soft);font-weight:500;white-space:nowrap;border-bottom-color:var(--soft)}
tbody th{font-weight:500}
.numbers th:not(:first-child),.numbers td{text-align:right}
.undefined-value::after{content:":"}.number .undefined-value::after{content:""}
.numbers td{white-space:nowrap}
.numbers td .reason,.numbers td.reason{white-space:normal;text-align:left;min-width:14em}
.numbers td.reason{max-width:24em}
.facts{width:100%}
.facts th{width:46%;color:var(--soft);font-weight:400}
.facts td{overflow-wrap:anywhere}
.columns{display:grid;grid-template-columns:repeat(2,minmax(0,1fr));gap:0 36px;align-items:start}
footer{margin-top:48px;padding-top:14px;border-top:1px solid var(--line);font-size:13px;color:var(--soft)}
@media (max-width:760px){body{padding:24px 16px 40px}.figures,.columns{grid-template-columns:minmax(0,1fr)}
.cards{grid-template-columns:minmax(0,1fr)}h1{font-size:22px}section{margin-top:36px}th,td{padding-right:12px}
.numbers td{white-space:normal}.numbers td.reason{min-width:8em}}
@media print{@page{margin:15mm}body{padding:0;max-width:none;font-size:11pt}section{margin-top:22pt}
figure,.card,.verdict,.warning,tr{break-inside:avoid}h2,h3{break-after:avoid}
.verdict,.warning,.card,.figure *{-webkit-print-color-adjust:exact;print-color-adjust:exact}}
)";

}  // namespace

std::string html_style() {
  std::string style = kColors;
  style += kLayout;
  style += figure_style();
  style += "@media (max-width:760px){.figure text{font-size:12.5px}}\n";  // figures shrink on phones, words must not
  style += "@media screen and (prefers-color-scheme:dark){";
  style += figure_style_dark();
  style += "}\n";
  return style;
}

}  // namespace trysquare::internal
