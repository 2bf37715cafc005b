# SPDX-License-Identifier: BSD-3-Clause
"""The sheet of HTML that a diagnosis is written on."""

from __future__ import annotations

PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{name} – {title}</title>
<style>
body {{ margin: 0 auto; max-width: 1120px; padding: 18px 24px 48px; color: {ink};
  font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; }}
.title {{ font-size: 15px; margin: 0 0 8px; }}
.verdict {{ background: {verdict}; color: white; padding: 18px 26px 20px; border-radius: 6px;
  display: grid; grid-template-columns: auto 1fr; column-gap: 24px; align-items: center; }}
.verdict .sign {{ font-size: 64px; line-height: 1; }}
.verdict h1 {{ font-size: 52px; line-height: 1.1; margin: 0; }}
.verdict p {{ font-size: 25px; line-height: 1.25; margin: 6px 0 0; }}
.tiles {{ display: flex; flex-wrap: wrap; gap: 12px; margin: 14px 0 6px; }}
.tiles div {{ flex: 1 1 190px; border: 1px solid #dcdcd8; border-radius: 6px;
  padding: 8px 14px 10px; }}
.tiles b {{ display: block; font-size: 23px; font-weight: 600; white-space: nowrap;
  font-variant-numeric: tabular-nums; }}
.tiles span {{ font-size: 13px; color: #555; }}
.warnings p {{ margin: 6px 0; padding: 6px 12px; border-left: 4px solid {red}; color: {red};
  background: #fdf0ef; }}
h2 {{ font-size: 20px; margin: 36px 0 6px; border-bottom: 2px solid #ddd; padding-bottom: 3px; }}
h2 i {{ font-style: normal; color: white; background: {ink}; border-radius: 50%;
  display: inline-block; width: 27px; height: 27px; line-height: 27px; text-align: center;
  font-size: 15px; margin-right: 10px; vertical-align: 2px; }}
h3 {{ font-size: 16px; margin: 0; }}
p, ul {{ margin: 6px 0; }}
.summary {{ display: flex; gap: 36px; align-items: flex-start; flex-wrap: wrap; }}
.summary > div {{ flex: 1 1 460px; }}
.summary > .facts {{ flex: 0 1 330px; }}
.summary h3 {{ margin-top: 14px; }}
table {{ border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: 13px;
  margin: 6px 0; }}
th {{ text-align: left; font-weight: 500; color: #555; padding: 2px 16px 2px 0;
  vertical-align: top; }}
td {{ padding: 2px 16px 2px 0; vertical-align: top; }}
td:nth-child(n+2) {{ white-space: nowrap; }}
.prose td:last-child {{ white-space: normal; }}
tr.strong td {{ font-weight: 600; }}
tr.weak td {{ color: #666; }}
.small {{ font-size: 13px; color: #555; }}
img {{ max-width: 100%; display: block; margin: 8px 0; }}
.card {{ border: 1px solid #dcdcd8; border-radius: 6px; padding: 12px 18px; margin: 12px 0; }}
.sides {{ display: flex; flex-wrap: wrap; gap: 8px 36px; }}
.sides > div {{ flex: 1 1 290px; }}
.gain {{ height: 9px; background: #ececea; border-radius: 4px; overflow: hidden; margin: 6px 0; }}
.gain i {{ display: block; height: 100%; background: {blue}; }}
.odds {{ width: 90px; min-width: 60px; }}
.odds i {{ display: block; height: 9px; margin-top: 6px; background: {blue}; min-width: 1px; }}
details summary {{ cursor: pointer; }}
@media (max-width: 700px) {{ .verdict h1 {{ font-size: 36px; }} .verdict p {{ font-size: 19px; }} }}
@media print {{ .card, img {{ break-inside: avoid; }} }}
</style>
</head>
<body>
<p class="title">{title}</p>
<div class="verdict"><div class="sign">{sign}</div>
<div><h1>{name}</h1><p>{headline}</p></div></div>
<div class="tiles">{tiles}</div>
<div class="warnings">{warnings}</div>
<div class="summary">
<div>
<h3>What was found</h3><p>{found}</p>
<h3>What to do next</h3><ul>{wanting}</ul>
</div>
<div class="facts"><table>{facts}</table></div>
</div>
<h2><i>1</i>Show: what geometry alone leaves</h2>
<p class="small">Each panel lays the same residuals against one quantity; against a joint, their
component along the way in which that joint moves the tip. Means of bins of equal counts, with 95 %
intervals. A yellow ground and a dot mark what is beyond noise. {marks}</p>
{show_picture}
{pair_picture}
{structures}
<h2><i>2</i>Name: which cause, and why</h2>
{causes}
{curve_picture}
{curves_note}
<h2><i>3</i>Extend: the model with the causes inside</h2>
{model}
<p>It holds where the data lie (blue, of what the joints can do); outside, the geometry alone
speaks.</p>
{support_picture}
{beyond}
<h2><i>4</i>Measure the gain: data that were not used</h2>
<p>{held}</p>
{gain_picture}
{parts}
{residuals}
{residuals_picture}
{poses}
</body>
</html>
"""
