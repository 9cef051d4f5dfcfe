#include "touch_proof.hpp"

#include "solid_axes.hpp"

namespace lekalo::io {
namespace {

using locate::TouchProof;

const char* name_of(locate::SolidTree::Axis axis) { return kSolidAxes[static_cast<std::size_t>(axis)]; }

void write_terms(JsonWriter& json, const TouchProof& proof, std::uint32_t first, std::uint32_t count) {
  json.key("terms").begin_list();
  for (std::uint32_t k = first; k < first + count; ++k) {
    const locate::TouchTerm& term = proof.terms[k];
    json.list({term.touch, term.ball, term.multiplier});
  }
  json.end();
}

}  // namespace

void write_touches(JsonWriter& json, const SolidTouchRecord& touches) {
  const TouchProof& proof = touches.proof;
  json.begin_object().fields(
      {{"ball", touches.ball}, {"form", touches.form}, {"directions", touches.directions}});
  json.key("pivot").list({proof.pivot.x, proof.pivot.y, proof.pivot.z});
  json.key("quaternion").list(proof.quaternion);
  for (std::size_t k = 0; k < kSolidAxes.size(); ++k)
    json.key(kSolidAxes[k]).list({proof.low[k], proof.high[k]});
  json.key("balls").list_of_lines(proof.balls, 4, 2, [&](const locate::SolidBall& ball) {
    json.list({ball.centre.x, ball.centre.y, ball.centre.z, ball.radius});
  });
  json.key("cuts").list_of_lines(proof.cuts, 4, 2, [&](const locate::TouchCut& cut) {
    json.begin_object().fields({{"axis", name_of(cut.axis)}, {"above", cut.above}, {"at", cut.at}});
    write_terms(json, proof, cut.first, cut.count);
    json.end();
  });
  const locate::SolidPose& moved = proof.moved;
  json.key("moved").begin_object().key("quaternion").list(moved.quaternion);
  json.fields({{"x", moved.shift.x}, {"y", moved.shift.y}, {"z", moved.shift.z}}).end();
  json.key("around").begin_list();
  for (const solid::Vector corner : {proof.around.low, proof.around.high})
    json.list({corner.x, corner.y, corner.z});
  json.end();
  json.key("ways").list_of_lines(proof.ways, 4, 2, [&](const locate::TouchWay& way) {
    json.begin_object().fields({{"corner", way.corner},
                                {"axis", name_of(way.axis)},
                                {"above", way.above},
                                {"at", way.at},
                                {"multiplier", way.multiplier}});
    write_terms(json, proof, way.first, way.count);
    json.end();
  });
  json.end();
}

}  // namespace lekalo::io
