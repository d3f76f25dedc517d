// Proves captures on an implementation when they are first needed, and selects those that show the attributes
// of a test.
#include <evalcts/capture/capture.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <iostream>

namespace evalcts {

Attributes Capture::shown_of(Attributes wanted) const {
  const Attributes shown = wanted & this->shown();
  const bool other_normals = wanted & ~shown & (kUnitNormal | kShaderNormal);
  return shown & kAllAttributes & ~(other_normals ? kNormal : 0u);
}

std::vector<std::unique_ptr<Capture>> all_captures() {
  std::vector<std::unique_ptr<Capture>> captures;
  captures.push_back(make_sink());
  captures.push_back(make_transform_feedback());
  captures.push_back(make_feedback_buffer());
  captures.push_back(make_pixels());
  return captures;
}

Captures::Captures(Implementation& implementation, const ImplementationInfo& info,
                   const std::vector<std::string>* names)
    : Captures(implementation, info, all_captures()) {
  if (!names) return;
  std::erase_if(captures_,
                [&](const Entry& entry) { return std::ranges::count(*names, entry.capture->name()) == 0; });
}

Captures::Captures(Implementation& implementation, const ImplementationInfo& info,
                   std::vector<std::unique_ptr<Capture>> captures)
    : implementation_(implementation), info_(info) {
  for (auto& capture : captures) captures_.push_back({std::move(capture)});
}

const Capture* Captures::proved(Entry& entry) {
  if (!entry.proved && entry.capture) {
    try {
      entry.capture->prove(implementation_, info_);
      entry.proved = true;
    } catch (const NotObservable& exception) {
      std::cout << "capture " << entry.capture->name() << " is not available: " << exception.what() << "\n";
      entry.capture.reset();
    }
  }
  return entry.capture.get();
}

void Captures::prove_all() {
  for (Entry& entry : captures_) proved(entry);
}

namespace {

// Returns words for the vertices that a capture has to show, behind "shows position".
const char* of_which(bool nonpositive_w) { return nonpositive_w ? " of vertices with w <= 0" : ""; }

}  // namespace

const Capture& Captures::showing_all(Attributes required, PrimitiveKinds kinds, bool nonpositive_w) {
  for (Entry& entry : captures_) {
    const Capture* const capture = proved(entry);
    if (!capture || (nonpositive_w && capture->loses_nonpositive_w())) continue;
    if (capture->takes(kinds) && (capture->attributes() & required) == required) return *capture;
  }
  throw NotObservable(fmt::format("no capture of this implementation shows {}{}", describe(required),
                                  of_which(nonpositive_w)));
}

Attributes Captures::shown_exactly(Attributes required, PrimitiveKinds kinds) {
  Attributes most = 0;
  for (Entry& entry : captures_) {
    if (most == required) break;  // the proof of another capture would be wasted
    const Capture* const capture = proved(entry);
    if (!capture || !capture->takes(kinds)) continue;
    const Attributes shown = required & capture->attributes();
    if (std::popcount(shown) > std::popcount(most)) most = shown;
  }
  if (most == 0)
    throw NotObservable(fmt::format("no capture of this implementation shows {}", describe(required)));
  return most;
}

std::vector<const Capture*> Captures::showing_most(Attributes required, PrimitiveKinds kinds,
                                                   bool nonpositive_w, std::size_t most) {
  const Attributes wanted = required & kAllAttributes;
  std::vector<const Capture*> chosen;
  Attributes shown = 0;
  for (Entry& entry : captures_) {
    if (shown == wanted && chosen.size() >= most) break;  // the proof of another capture would be wasted
    if (shown == wanted && entry.capture && entry.capture->is_last_resort()) continue;
    const Capture* const capture = proved(entry);
    if (!capture || (nonpositive_w && capture->loses_nonpositive_w()) || !capture->takes(kinds)) continue;
    const Attributes of_this = capture->shown_of(required);
    if (std::popcount(of_this) > std::popcount(shown)) {
      chosen = {capture};
      shown = of_this;
    } else if (of_this != 0 && (of_this & shown) == shown) {
      chosen.push_back(capture);
    }
  }
  if (chosen.empty())
    throw NotObservable(fmt::format("no capture of this implementation shows {}{}", describe(required),
                                    of_which(nonpositive_w)));
  if (chosen.size() > most) chosen.resize(most);
  return chosen;
}

WrappedCase begin_wrapping(gl::Case prologue, const gl::Case& script) {
  WrappedCase wrapped{std::move(prologue), {}, {}};
  wrapped.error_before = wrapped.commands.GetError();
  wrapped.commands.append(script);
  wrapped.error_after = wrapped.commands.GetError();
  return wrapped;
}

}  // namespace evalcts
