// Implements Conditions.
#include <evalcts/testkit/conditions.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include <evalcts/gl/call_in_flight.h>
#include <evalcts/gl/tokens.h>

namespace evalcts {

int Conditions::order_limit() const {
  if (subject_.info.max_eval_order == 0)
    throw NotObservable("MAX_EVAL_ORDER is not answered, so that no order is known to be too high");
  return std::max(subject_.info.max_eval_order, 8);
}

int Conditions::texture_units() const { return std::clamp(gl().texture_units, 1, reference::kTextureUnits); }

Depth Conditions::depth() const {
  if (subject_.depth == Depth::kFull && !delivery_.is_plain()) return Depth::kQuick;
  return subject_.depth;
}

int Conditions::by_depth(int quick, int full, int thorough) const {
  return std::array{quick, full, thorough}.at(static_cast<std::size_t>(depth()));
}

void Conditions::require(int major, int minor, const std::string& or_extension) const {
  if (subject_.info.at_least(major, minor)) return;
  if (!or_extension.empty() && subject_.info.extensions.count(or_extension)) return;
  throw NotSupported(
      fmt::format("needs GL {}.{}{}{}", major, minor, or_extension.empty() ? "" : " or ", or_extension));
}

void Conditions::prefer_fresh_contexts() const {
  if (subject_.is_warm) throw FreshContextsDecide("the test needs fresh contexts");
}

void Conditions::require_initial_state() const {
  if (subject_.info.shares_state)
    throw NotObservable("all contexts have one state, which is restored by calls");
  prefer_fresh_contexts();
}

bool Conditions::can_call(gl::EntryPoint command) {
  if (gl().has(command)) return true;
  missing_.insert(fmt::format("{} (missing)", gl::name_of(command)));
  return false;
}

bool Conditions::can_query_grid(GLenum name) {
  if (!gl().rejected_grid_queries.contains(name)) return true;
  missing_.insert(fmt::format("{} (the query is rejected)", gl::token_name(name)));
  return false;
}

std::vector<gl::Ref> Conditions::append_optional(gl::Case& c, const gl::Case& optional) {
  std::vector<gl::Ref> places;
  for (const gl::Command& command : optional.commands()) {
    // Commands that a sink does not declare are not supported.
    if (!gl().declaration && !can_call(command.entry)) {
      places.emplace_back();
      continue;
    }
    if (!subject_.omitted_calls.empty()) {
      const std::string call = gl::call_text(command);
      if (subject_.omitted_calls.contains(call)) {
        if (std::ranges::count(record_.left_out, call) == 0) record_.left_out.push_back(call);
        places.emplace_back();
        continue;
      }
    }
    places.push_back(c.add(command));
  }
  if (!places.empty() && std::ranges::all_of(places, [](gl::Ref place) { return place.index < 0; }))
    throw NotObservable("none of the queries can be called");
  return places;
}

}  // namespace evalcts
