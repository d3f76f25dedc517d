// The control that each capture has to reproduce before it is trusted: explicit vertices with known values.
#pragma once

#include <optional>

#include <evalcts/capture/capture.h>
#include <evalcts/gl/case.h>

namespace evalcts {

struct Control {
  gl::Case commands;
  std::vector<ObservedVertex> vertices;
};

struct ControlOptions {
  bool negative_w = false;       // include vertices with w < 0 and w = 0
  bool unclamped_color = false;  // include colours outside [0,1]
};

// Points with awkward but ordinary values: both signs, many magnitudes, full significands. No -0, no
// subnormal and no non-finite values, which feedback need not preserve.
Control make_control(const ControlOptions& options);

// Empty if the observation reproduces the control bit for bit in the given attributes (unit 0 only),
// otherwise what is wrong.
std::string compare(const Control& control, const Observation& observation, Attributes attributes);

// Plays the control through the capture. Empty if it came back unchanged, otherwise what is wrong. Throws as
// Capture::observe does.
std::string try_control(const Capture& capture, Implementation& implementation, const ControlOptions& options,
                        Attributes attributes);

// Returns those of the attributes that the capture reproduces; none if it does not work at all.
Attributes confirm_attributes(const Capture& capture, Implementation& implementation,
                              const ControlOptions& options, Attributes attributes);

// Returns twice the largest error of the control's colours, if that is small enough for a quantiser of at
// least 6 bits.
std::optional<double> measure_color_error(const Capture& capture, Implementation& implementation);

}  // namespace evalcts
