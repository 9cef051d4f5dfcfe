#include "lekalo/draw/pocket_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "draw/paper/colour.hpp"
#include "draw/paper/printed_number.hpp"
#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/text/words.hpp"
#include "region_rings.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using geom::Ring;

constexpr Rect kPocketPage{0, 0, 250, 160};
constexpr Rect kPocketDrawing{6, 8, 172, 138};
constexpr Rect kPocketPanel{186, 8, 58, 144};
constexpr Colour kEntry{32, 122, 76}, kAir{150, 158, 168};
constexpr double kAirDegrees = 3, kMostDegrees = 180;
constexpr int kBands = 12;  // of engagement, each of one colour

/// Makes low engagement dark and cold, and high engagement bright and warm.
Colour band_colour(int band) {
  return scale_colour(kColourSteps - 1 - band * (kColourSteps - 1) / (kBands - 1));
}

/// The look of a stretch: -2 for entry, -1 for air, else its band of engagement.
int look_of(const PocketStretch& s) {
  if (s.entry) return -2;
  if (s.engagement_deg < kAirDegrees) return -1;
  return std::min(kBands - 1, static_cast<int>(s.engagement_deg / (kMostDegrees / kBands)));
}

class PocketComposer {
 public:
  explicit PocketComposer(const PocketPicture& picture) : picture_(picture) {
    scene_.width = kPocketPage.width, scene_.height = kPocketPage.height;
    geom::Box box = geom::bounds(picture.pockets.front().outer);
    for (const geom::Region& pocket : picture.pockets) box = joined(box, geom::bounds(pocket.outer));
    view_ = fitted(box, kPocketDrawing.grown(-2));
  }

  Scene compose() && {
    scene_.title = "lekalo pocket: " + picture_.name;
    scene_.description = fmt::format("tool {:g} mm", picture_.tool_diameter);
    add(PathItem{{kPocketPage.ring()}, true, filled(kPaper), {"page", ""}});
    Paint material = filled(kBlankFill);
    material.stroke = kBlankLine, material.width = 0.35;
    add(PathItem{paper_rings(picture_.pockets), true, material, {"pocket", "the pocket"}});
    if (!picture_.fragments.empty()) {
      Paint dashed = stroked_round(kGrey, 0.3);
      dashed.dash = 1.2;
      add(PathItem{paper_rings(picture_.fragments), true, dashed, {"fragments", "convex fragments"}});
    }
    draw_path();
    draw_unreachable();
    for (const Point p : picture_.uncut)
      add(DotItem{view_(p), 1.4, stroked_round(kOutside, 0.4), {"uncut", "not cut"}});
    scale_bar();
    draw_panel();
    return std::move(scene_);
  }

 private:
  void add(Item item) { scene_.items.push_back(std::move(item)); }
  void text(double x, double y, const std::string& words, double size, Anchor anchor = Anchor::start,
            Colour colour = kInk, bool bold = false) {
    add(TextItem{{x, y}, words, size, anchor, colour, bold, {"text", ""}});
  }

  [[nodiscard]] std::vector<Ring> paper_rings(const std::vector<geom::Region>& regions) const {
    std::vector<Ring> rings;
    for (const Ring& ring : region_rings(regions, 0.02 / view_.scale, 5 / view_.scale))
      rings.push_back(on_paper(ring, view_, kPocketDrawing));
    return rings;
  }

  /// Draws stretches of one look that hang together as one line, and looks one above the other with air
  /// below, so that what cuts is never hidden.
  void draw_path() {
    constexpr double kNear = 1e-3;  // mm
    const auto width = [](int look) { return look == -1 ? 0.12 : 0.3; };
    for (int look = -1; look <= kBands; ++look) {
      const int wanted = look == kBands ? -2 : look;
      std::vector<Ring> lines;
      Ring line;
      const auto flush = [&] {
        if (line.size() > 1) lines.push_back(thinned(line));
        line.clear();
      };
      for (const PocketStretch& s : picture_.path) {
        ask();
        if (look_of(s) != wanted) {
          flush();
          continue;
        }
        if (!line.empty() && geom::norm(line.back() - s.from) > kNear) flush();
        if (line.empty()) line.push_back(s.from);
        line.push_back(s.to);
      }
      flush();
      if (lines.empty()) continue;
      const Colour colour = wanted == -2 ? kEntry : wanted == -1 ? kAir : band_colour(wanted);
      const std::string title =
          wanted == -2   ? "entry"
          : wanted == -1 ? fmt::format("engagement below {:g} degrees", kAirDegrees)
                         : fmt::format("engagement {:g} to {:g} degrees", wanted * kMostDegrees / kBands,
                                       (wanted + 1) * kMostDegrees / kBands);
      add(PathItem{std::move(lines), false, stroked_round(colour, width(wanted)), {"path", title}});
    }
  }

  /// The line on paper, without places that a straight line passes within a hundredth of a millimetre.
  [[nodiscard]] Ring thinned(const Ring& line) const {
    constexpr double kOff = 0.01;
    Ring kept{view_(line.front())};
    std::size_t anchor = 0;
    for (std::size_t i = 2; i < line.size(); ++i) {
      const Point a = view_(line[anchor]), way = view_(line[i]) - a;
      const double whole = geom::norm(way);
      bool straight = i - anchor < 200;
      for (std::size_t k = anchor + 1; k < i && straight; ++k)
        straight = std::abs(cross(way, view_(line[k]) - a)) <= kOff * whole;
      if (straight) continue;
      kept.push_back(view_(line[i - 1]));
      anchor = i - 1;
    }
    kept.push_back(view_(line.back()));
    return kept;
  }

  void draw_unreachable() {
    if (picture_.unreachable.empty()) return;
    const std::vector<Ring> rings = paper_rings(picture_.unreachable);
    add(PathItem{rings, true, filled(kOutside, 0.25), {"unreachable", "the tool does not fit in here"}});
    add(ClipBegin{rings});
    std::vector<Ring> lines;
    for (double x = kPocketDrawing.x - kPocketDrawing.height; x < kPocketDrawing.right(); x += 1.2)
      lines.push_back({{x, kPocketDrawing.bottom()}, {x + kPocketDrawing.height, kPocketDrawing.y}});
    add(PathItem{std::move(lines), false, stroked_round(kOutside, 0.2), {"hatch", ""}});
    add(ClipEnd{});
  }

  void scale_bar() {
    const double length = round_length(40 / view_.scale), on_page = length * view_.scale;
    const double x = kPocketDrawing.x + 3, y = kPocketPage.bottom() - 6;
    add(PathItem{{{{x, y - 1.2}, {x, y}, {x + on_page, y}, {x + on_page, y - 1.2}}},
                 false,
                 stroked_round(kInk, 0.35),
                 {"scale-bar", ""}});
    text(x + on_page + 2.5, y, length_scale(length, length).text_with_unit(length), 3.1);
  }

  void draw_panel() {
    double y = kPocketPanel.y + 3.5;
    const std::string name = io::shortened(picture_.name, kPocketPanel.width / 3.8);
    text(kPocketPanel.x, y, name, 3.8, Anchor::start, kInk, true);
    text(kPocketPanel.x, y += 5, fmt::format("tool {:g} mm", picture_.tool_diameter), 3);
    y += 4;
    for (const auto& [what, value] : picture_.figures) {
      text(kPocketPanel.x, y += 5, what, 2.8, Anchor::start, kGrey);
      text(kPocketPanel.right(), y, value, io::fitting_size(value, 2.8, 0.62 * kPocketPanel.width),
           Anchor::end);
    }
    y += 8;
    text(kPocketPanel.x, y, "engagement of the rim", 2.8);
    const double width = kPocketPanel.width / kBands;
    for (int band = 0; band < kBands; ++band) {
      const Rect box{kPocketPanel.x + band * width, y + 1.5, width, 4};
      add(PathItem{{box.ring()}, true, filled(band_colour(band)), {"scale", ""}});
    }
    for (int degrees = 0; degrees <= 180; degrees += 45)
      text(kPocketPanel.x + kPocketPanel.width * degrees / kMostDegrees, y + 8.6, fmt::format("{}°", degrees),
           2.5,
           degrees == 0     ? Anchor::start
           : degrees == 180 ? Anchor::end
                            : Anchor::middle);
    y += 13;
    const auto key = [&](Colour colour, const char* words, double line) {
      add(PathItem{
          {{{kPocketPanel.x, y}, {kPocketPanel.x + 6, y}}}, false, stroked_round(colour, line), {"key", ""}});
      text(kPocketPanel.x + 8, y + 0.9, words, 2.6);
      y += 4.4;
    };
    key(kAir, "less than 3°: through air", 0.25);
    key(kEntry, "entry", 0.5);
    if (!picture_.unreachable.empty()) key(kOutside, "the tool does not fit", 1.6);
    if (!picture_.uncut.empty()) key(kOutside, "not cut (rings)", 0.4);
  }

  const PocketPicture& picture_;
  Scene scene_;
  View view_;
};

std::string json_points(const Ring& ring) {
  std::string text = "[";
  for (const Point p : ring) text += fmt::format("{}[{:.3f},{:.3f}]", text.size() > 1 ? "," : "", p.x, p.y);
  return text + "]";
}

}  // namespace

std::string pocket_svg(const PocketPicture& picture) { return scene_svg(PocketComposer(picture).compose()); }

Result<std::string> pocket_png(const PocketPicture& picture, int width_px) {
  return scene_png(PocketComposer(picture).compose(), width_px);
}

std::string pocket_animation(const PocketPicture& picture) {
  constexpr std::size_t kMost = 20000;
  const std::size_t each = picture.path.size() / kMost + 1;
  std::string data = "const rings=[", path;
  for (const geom::Ring& ring : region_rings(picture.pockets, 0.02, 5)) data += json_points(ring) + ",";
  data += "];\nconst lost=[";
  for (const geom::Ring& ring : region_rings(picture.unreachable, 0.02, 5)) data += json_points(ring) + ",";
  // Each place has x, y, engagement, and how the tool came there (0: a jump, 1: on, 2: entry). The most
  // engaged place speaks for those that are left out.
  double most = 0;
  const auto put = [&](geom::Point p, double engagement, int how) {
    path += fmt::format("{:.3f},{:.3f},{:.1f},{},\n", p.x, p.y, engagement, how);
  };
  for (std::size_t i = 0; i < picture.path.size(); ++i) {
    const PocketStretch& s = picture.path[i];
    const bool jump = i == 0 || geom::norm(s.from - picture.path[i - 1].to) > 1e-3;
    if (jump) put(s.from, 0, 0);
    most = std::max(most, s.engagement_deg);
    const bool last = i + 1 == picture.path.size() || geom::norm(picture.path[i + 1].from - s.to) > 1e-3;
    if (i % each != 0 && !last) continue;
    put(s.to, most, s.entry ? 2 : 1);
    most = 0;
  }
  data += fmt::format("];\nconst radius={:.6g};\nconst path=[{}];\n", picture.tool_diameter / 2, path);
  static constexpr const char* kBefore = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<style>body{font:14px sans-serif;margin:12px;color:#1f242b}canvas{width:100%;border:1px solid #d6dbe1;display:block}
#bar{display:flex;gap:8px;align-items:center;margin:8px 0}#at{flex:1}</style>
)";
  static constexpr const char* kAfter = R"(
const el=id=>document.getElementById(id),view=el('view'),graph=el('graph'),n=path.length/4;
const along=new Float64Array(n);let box=[1e9,1e9,-1e9,-1e9];
for(const r of rings)for(const[x,y]of r)box=[Math.min(box[0],x),Math.min(box[1],y),Math.max(box[2],x),Math.max(box[3],y)];
for(let i=1;i<n;i++)along[i]=along[i-1]+(path[4*i+3]?Math.hypot(path[4*i]-path[4*i-4],path[4*i+1]-path[4*i-3]):0);
const W=1200,scale=(W-20)/(box[2]-box[0]),H=Math.min(900,Math.ceil((box[3]-box[1])*scale)+20);
const k=Math.min(scale,(H-20)/(box[3]-box[1]));view.width=W;view.height=H;graph.width=W;graph.height=160;
const X=x=>10+(x-box[0])*k,Y=y=>H-10-(y-box[1])*k;
const hue=e=>`hsl(${Math.max(0,220-e*1.4)} 80% 45%)`;
const outline=(c,all)=>{c.beginPath();for(const r of all){r.forEach(([x,y],i)=>i?c.lineTo(X(x),Y(y)):c.moveTo(X(x),Y(y)));c.closePath();}};
const base=document.createElement('canvas');base.width=W;base.height=H;let shown=0;
function clear(){const c=base.getContext('2d');c.clearRect(0,0,W,H);outline(c,rings);c.fillStyle='#c9d1da';c.fill('evenodd');shown=0;}
function cutTo(i){const c=base.getContext('2d');if(i<shown)clear();
 c.lineCap='round';c.lineJoin='round';c.lineWidth=2*radius*k;c.strokeStyle='#fff';
 c.save();c.globalCompositeOperation='source-atop';c.beginPath();for(let j=shown;j<=i;j++)(j>0&&path[4*j+3]&&j>shown)?c.lineTo(X(path[4*j]),Y(path[4*j+1])):c.moveTo(X(path[4*j]),Y(path[4*j+1]));c.stroke();c.restore();shown=i;}
const g=document.createElement('canvas');g.width=W;g.height=160;{const c=g.getContext('2d');c.strokeStyle='#d6dbe1';c.font='11px sans-serif';c.fillStyle='#606974';
 for(const d of[45,90,135,180]){const y=150-d*0.8;c.beginPath();c.moveTo(0,y);c.lineTo(W,y);c.stroke();c.fillText(d+'\u00b0',2,y-2);}
 for(let i=1;i<n;i++){if(!path[4*i+3])continue;const x0=along[i-1]/along[n-1]*W,x1=along[i]/along[n-1]*W,e=path[4*i+2];c.fillStyle=path[4*i+3]==2?'#207a4c':hue(e);c.fillRect(x0,150-e*0.8,Math.max(0.6,x1-x0),Math.max(0.8,e*0.8));}}
let at=0,playing=true,last=0;
function draw(){let lo=0,hi=n-1;while(lo<hi){const m=(lo+hi)>>1;along[m]<at?lo=m+1:hi=m;}
 const i=lo;cutTo(i);const c=view.getContext('2d');c.clearRect(0,0,W,H);c.drawImage(base,0,0);
 outline(c,rings);c.lineWidth=1.5;c.strokeStyle='#6e7a88';c.stroke();outline(c,lost);c.fillStyle='#d0001b66';c.fill('evenodd');
 const x=X(path[4*i]),y=Y(path[4*i+1]),e=path[4*i+2];c.beginPath();c.arc(x,y,radius*k,0,7);c.fillStyle=hue(e)+'';c.globalAlpha=0.55;c.fill();c.globalAlpha=1;c.lineWidth=2;c.strokeStyle='#1f242b';c.stroke();
 const q=graph.getContext('2d');q.clearRect(0,0,W,160);q.drawImage(g,0,0);const gx=at/along[n-1]*W;q.fillStyle='#d0001b';q.fillRect(gx-1,0,2,160);
 el('now').textContent=`${at.toFixed(0)} mm, ${e.toFixed(0)}\u00b0`;el('at').value=1000*at/along[n-1];}
function tick(t){const dt=Math.min(0.1,(t-last)/1000);last=t;if(playing){at=Math.min(along[n-1],at+dt*25*el('speed').value);if(at>=along[n-1])playing=false;draw();}requestAnimationFrame(tick);}
el('play').onclick=()=>{if(at>=along[n-1])at=0;playing=!playing;};el('at').oninput=()=>{at=el('at').value/1000*along[n-1];draw();};
clear();draw();requestAnimationFrame(tick);
</script></body></html>
)";
  const std::string name = io::xml_text(picture.name);
  std::string figures;
  for (const auto& [what, value] : picture.figures)
    figures += fmt::format("{}{} {}", figures.empty() ? "" : ", ", what, value);
  return kBefore +
         fmt::format(
             "<title>lekalo pocket: {0}</title></head><body>\n<p><b>{0}</b>, tool {1:g} mm: {2}</p>\n", name,
             picture.tool_diameter, io::xml_text(figures)) +
         "<div id=\"bar\"><button id=\"play\">play / pause</button><label>speed <input id=\"speed\" "
         "type=\"range\" "
         "min=\"1\" max=\"60\" value=\"10\"></label><input id=\"at\" type=\"range\" max=\"1000\" value=\"0\">"
         "<span id=\"now\"></span></div>\n<canvas id=\"view\"></canvas><canvas "
         "id=\"graph\"></canvas>\n<script>\n" +
         data + kAfter;
}

}  // namespace lekalo::draw
