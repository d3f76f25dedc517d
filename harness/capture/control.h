// The control that each capture must reproduce before it is used: explicit vertices with known values.
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

// Makes a control of points with finite normal values: both signs, many magnitudes, full significands. It has
// no -0, subnormal or non-finite values, which feedback need not preserve.
Control make_control(const ControlOptions& options);

// Returns an empty string if the observation reproduces the control bit for bit in the given attributes (unit
// 0 only), otherwise a description of the difference.
std::string compare(const Control& control, const Observation& observation, Attributes attributes);

// Runs the control through the capture. Returns an empty string if the given attributes came back unchanged,
// otherwise a description of the difference. Throws the exceptions of Capture::observe.
std::string try_control(const Capture& capture, Implementation& implementation, const ControlOptions& options,
                        Attributes attributes);

// Returns the subset of the attributes that the capture reproduces; 0 if it does not work at all.
Attributes confirm_attributes(const Capture& capture, Implementation& implementation,
                              const ControlOptions& options, Attributes attributes);

// Returns twice the largest error of the control's colours; empty if an error exceeds the step of 6-bit
// colours (1/63), or the control cannot be observed.
std::optional<double> measure_color_error(const Capture& capture, Implementation& implementation);

}  // namespace evalcts
