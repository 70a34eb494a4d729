// What the pages of reports have in common.
#include "base/printed.h"
#include "rehearse/outputs.h"

namespace understudy::rehearse {
namespace {

constexpr char kStyle[] = R"css(
:root { --ink: #1d2530; --dim: #66717f; --line: #d9dee5; --paper: #fff; --ground: #f4f6f8;
        --good: #1a7f4b; --bad: #c0322b; --none: #9a6b00; --signal: #1f5fa8; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e8ed; --dim: #97a1ad; --line: #333c47; --paper: #1b2028; --ground: #12161b;
          --good: #4cc38a; --bad: #ff6b61; --none: #e2b04a; --signal: #6cb0ff; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink);
       font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 28px 20px 60px; }
h1 { font-size: 26px; margin: 0 0 2px; } h2 { font-size: 18px; margin: 34px 0 10px; }
p { margin: 4px 0; } .dim { color: var(--dim); }
code, pre { font: 13px/1.45 ui-monospace, "DejaVu Sans Mono", monospace; }
pre { background: var(--paper); border: 1px solid var(--line); border-radius: 6px; padding: 10px 12px;
      overflow-x: auto; margin: 6px 0; }
.word { display: inline-block; min-width: 92px; text-align: center; border-radius: 4px; color: #fff;
        font-weight: 600; font-size: 13px; padding: 1px 8px; }
.passed .word, .word.passed { background: var(--good); }
.failed .word, .word.failed { background: var(--bad); }
.none .word, .word.none { background: var(--none); }
header { border-bottom: 1px solid var(--line); padding-bottom: 14px; }
table { border-collapse: collapse; width: 100%; background: var(--paper); border: 1px solid var(--line);
        border-radius: 6px; }
td, th { text-align: left; padding: 6px 10px; border-top: 1px solid var(--line); vertical-align: top; }
th { font-weight: 600; color: var(--dim); font-size: 13px; } tr:first-child > * { border-top: 0; }
th.number { text-align: right; }
td.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
.beyond { color: var(--bad); font-weight: 600; }
a { color: inherit; }
section.claim { background: var(--paper); border: 1px solid var(--line); border-left: 5px solid;
                border-radius: 6px; padding: 12px 16px; margin: 12px 0; }
section.passed { border-left-color: var(--good); } section.failed { border-left-color: var(--bad); }
section.none { border-left-color: var(--none); }
section.claim h3 { margin: 0 0 4px; font-size: 16px; } .plots { display: flex; flex-wrap: wrap; gap: 8px; }
.pictures { display: grid; grid-template-columns: repeat(auto-fit, minmax(240px, 1fr)); gap: 8px; }
.pictures figure { margin: 0; max-width: 480px; }
figure { margin: 8px 0 0; } figcaption { color: var(--dim); font-size: 12px; }
svg, img { max-width: 100%; height: auto; display: block; }
svg text { fill: var(--dim); font: 11px system-ui, "DejaVu Sans", sans-serif; }
.ylabel { text-anchor: end; } .xlabel, .axis { text-anchor: middle; }
.grid { stroke: var(--line); stroke-width: 1; } .window { fill: var(--signal); opacity: .07; }
.signal { fill: none; stroke: var(--signal); stroke-width: 1.5; stroke-linejoin: round; }
.other { fill: none; stroke: var(--bad); stroke-width: 1.2; stroke-linejoin: round; opacity: .8; }
.limit { stroke: var(--ink); stroke-width: 1.2; stroke-dasharray: 5 4; }
.instant { stroke: var(--bad); stroke-width: 1.5; } .passed .instant { stroke: var(--good); }
.event { stroke: var(--none); stroke-width: 2; }
.above { background: var(--paper); border: 1px solid var(--line); } .above path { stroke-width: 2; }
.ring { fill: none; stroke: var(--line); } .above .robot { fill: var(--bad); stroke: var(--paper); stroke-width: 1; }
.height0 { stroke: #b9c2cc; } .height1 { stroke: #4c9ed9; } .height2 { stroke: #35a46f; }
.height3 { stroke: #d9a51f; } .height4 { stroke: #d9622b; } .height5 { stroke: #9a4fb0; }
@media print { body { background: #fff; } section.claim { break-inside: avoid; } }
)css";

}  // namespace

std::string HtmlClass(judge::Outcome outcome) {
  if (outcome == judge::Outcome::kPassed) return "passed";
  return outcome == judge::Outcome::kFailed ? "failed" : "none";
}

std::string Badge(judge::Outcome outcome) {
  return "<span class=\"word " + HtmlClass(outcome) + "\">" + std::string(judge::Name(outcome)) +
         "</span>";
}

std::string HtmlPage(const std::string& title, const std::string& content) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta name=\"viewport\" content=\"width=device-width\"><title>" +
         Escaped(title) + "</title><style>" + kStyle + "</style></head><body><main>\n" + content +
         "</main></body></html>\n";
}

}  // namespace understudy::rehearse
