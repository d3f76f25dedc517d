// Formats commands, arguments and constants as C. Long arrays are abbreviated in failure records.
#include <evalcts/gl/call_log.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include <evalcts/gl/hexadecimal.h>
#include <evalcts/gl/tokens.h>

namespace evalcts::gl {
namespace {

template <class T>
std::string constant(T value, const char* suffix) {
  if (std::isnan(value)) return "NAN";
  if (std::isinf(value)) return value > 0 ? "INFINITY" : "-INFINITY";
  // Small integers are exact in decimal and more readable.
  if (value == std::trunc(value) && std::abs(value) < 1e6)
    return fmt::format("{}{:.1f}{}", std::signbit(value) && value == 0 ? "-" : "", value == 0 ? T{0} : value,
                       suffix);
  return hexadecimal(value) + suffix;
}

std::string element(Scalar type, const std::byte* bytes) {
  const auto as = [bytes]<class T>(T value) {
    std::memcpy(&value, bytes, sizeof value);
    return value;
  };
  switch (type) {
    case Scalar::kU8:
      return fmt::format("{}", as(std::uint8_t{}));
    case Scalar::kI8:
      return fmt::format("{}", static_cast<int>(as(std::int8_t{})));
    case Scalar::kI32:
      return fmt::format("{}", as(std::int32_t{}));
    case Scalar::kU32:
      return fmt::format("{}", as(std::uint32_t{}));
    case Scalar::kI64:
      return fmt::format("{}", as(std::int64_t{}));
    case Scalar::kF32:
      return c_constant(as(0.0f));
    case Scalar::kF64:
      return c_constant(as(0.0));
  }
  return "";
}

const char* after_call(AfterCall after) {
  switch (after) {
    case AfterCall::kKeep:
      return "";
    case AfterCall::kOverwrite:
      return " /* overwritten after the call */";
    case AfterCall::kUnmap:
      return " /* unmapped after the call */";
    case AfterCall::kProtect:
      return " /* protected after the call */";
  }
  return "";
}

// Returns a mask of attribute groups or buffers by their names, if there are few.
std::string bits(GLbitfield mask) {
  const std::vector<const char*> names = names_of_bits(mask);
  if (names.empty() || names.size() > 4) return fmt::format("0x{:X}", mask);
  return fmt::format("{}", fmt::join(names, " | "));
}

std::string argument(const Value& value, char kind, std::size_t most_elements) {
  if (std::holds_alternative<std::nullptr_t>(value)) return "NULL";
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    switch (kind) {
      case 'e':
        return token_name(static_cast<GLenum>(*integer));
      case 'm':
        return primitive_name(static_cast<GLenum>(*integer));
      case 'b':
        return bits(static_cast<GLbitfield>(*integer));
      case 'z':
        return *integer ? "GL_TRUE" : "GL_FALSE";
      default:
        return fmt::format("{}", *integer);
    }
  }
  if (const auto* single = std::get_if<float>(&value)) return c_constant(*single);
  if (const auto* real = std::get_if<double>(&value)) return c_constant(*real);
  if (const auto* result = std::get_if<ResultOf>(&value))
    return result->element < 0 ? fmt::format("result_{}", result->command)
                               : fmt::format("array_{}[{}]", result->command, result->element);
  if (const auto* output = std::get_if<Output>(&value))
    return fmt::format("({}[{}]){{0}}", c_type(output->type), std::max<std::size_t>(output->count, 1));
  if (const auto* strings = std::get_if<Strings>(&value)) {
    std::string text = "(const GLchar*[]){";
    for (std::size_t i = 0; i < strings->values.size(); ++i)
      text += (i ? ", " : "") + quoted(strings->values[i]);
    return text + "}";
  }
  const Input& input = std::get<Input>(value);
  return fmt::format("({}[]){{{}}}{}", c_type(input.type), elements_of(input, most_elements),
                     after_call(input.after));
}

}  // namespace

std::vector<const char*> names_of_bits(GLbitfield mask) {
  constexpr std::pair<GLbitfield, const char*> kBits[] = {{GL_CURRENT_BIT, "GL_CURRENT_BIT"},
                                                          {GL_POINT_BIT, "GL_POINT_BIT"},
                                                          {GL_LINE_BIT, "GL_LINE_BIT"},
                                                          {GL_POLYGON_BIT, "GL_POLYGON_BIT"},
                                                          {GL_POLYGON_STIPPLE_BIT, "GL_POLYGON_STIPPLE_BIT"},
                                                          {GL_PIXEL_MODE_BIT, "GL_PIXEL_MODE_BIT"},
                                                          {GL_LIGHTING_BIT, "GL_LIGHTING_BIT"},
                                                          {GL_FOG_BIT, "GL_FOG_BIT"},
                                                          {GL_DEPTH_BUFFER_BIT, "GL_DEPTH_BUFFER_BIT"},
                                                          {GL_ACCUM_BUFFER_BIT, "GL_ACCUM_BUFFER_BIT"},
                                                          {GL_STENCIL_BUFFER_BIT, "GL_STENCIL_BUFFER_BIT"},
                                                          {GL_VIEWPORT_BIT, "GL_VIEWPORT_BIT"},
                                                          {GL_TRANSFORM_BIT, "GL_TRANSFORM_BIT"},
                                                          {GL_ENABLE_BIT, "GL_ENABLE_BIT"},
                                                          {GL_COLOR_BUFFER_BIT, "GL_COLOR_BUFFER_BIT"},
                                                          {GL_HINT_BIT, "GL_HINT_BIT"},
                                                          {GL_EVAL_BIT, "GL_EVAL_BIT"},
                                                          {GL_LIST_BIT, "GL_LIST_BIT"},
                                                          {GL_TEXTURE_BIT, "GL_TEXTURE_BIT"},
                                                          {GL_SCISSOR_BIT, "GL_SCISSOR_BIT"}};
  std::vector<const char*> names;
  for (const auto& [bit, name] : kBits) {
    if ((mask & bit) == 0) continue;
    names.push_back(name);
    mask &= ~bit;
  }
  return mask == 0 ? names : std::vector<const char*>();
}

std::string c_constant(float value) { return constant(value, "f"); }
std::string c_constant(double value) { return constant(value, ""); }

const char* c_type(Scalar type) {
  switch (type) {
    case Scalar::kU8:
      return "GLubyte";
    case Scalar::kI8:
      return "GLchar";
    case Scalar::kI32:
      return "GLint";
    case Scalar::kU32:
      return "GLuint";
    case Scalar::kI64:
      return "GLint64";
    case Scalar::kF32:
      return "GLfloat";
    case Scalar::kF64:
      return "GLdouble";
  }
  return "GLubyte";
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '\n') {
      out += "\\n";
      continue;
    }
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string elements_of(const Input& input, std::size_t most_elements) {
  const std::size_t size = size_of(input.type);
  const std::size_t count = input.bytes.size() / size;
  const std::size_t shown = most_elements == 0 ? count : std::min(count, most_elements);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i)
    text += (i ? ", " : "") + element(input.type, input.bytes.data() + i * size);
  if (shown < count) text += fmt::format(", /* {} more */", count - shown);
  return text;
}

std::string to_c(const Command& command, std::size_t most_elements) {
  return to_c(command, {}, most_elements);
}

std::string to_c(const Command& command, const OwnText& own, std::size_t most_elements) {
  const auto number = [&](std::size_t i) { return argument(command.arguments[i], '.', 0); };
  switch (command.entry) {  // calls of functions that the C program defines
    case EntryPoint::OtherContextEVALCTS:
      return fmt::format("use_context({}, 0);", number(0));
    case EntryPoint::SharingContextEVALCTS:
      return fmt::format("use_context({}, 1); /* shares objects with context 0 */", number(0));
    case EntryPoint::ContextOfKindEVALCTS:
      return fmt::format("use_context({}, 1 + {});", number(0), number(1));
    default:
      break;
  }
  const std::string_view kinds = parameter_kinds(command.entry);
  std::string text = std::string(name_of(command.entry)) + "(";
  for (std::size_t i = 0; i < command.arguments.size(); ++i) {
    const std::string given = own ? own(i) : std::string();
    text += (i ? ", " : "") +
            (given.empty() ? argument(command.arguments[i], i < kinds.size() ? kinds[i] : '.', most_elements)
                           : given);
  }
  return text + ");";
}

std::vector<std::string> to_c(const Case& script, int first, int last, std::size_t most_lines,
                              std::size_t most_elements) {
  std::vector<std::string> lines;
  const auto& commands = script.commands();
  first = std::max(first, 0);
  last = std::min(last, static_cast<int>(commands.size()) - 1);
  const int count = last - first + 1;
  const int most = static_cast<int>(most_lines);
  for (int i = first; i <= last; ++i) {
    if (count > most && i - first == most / 2) {
      const int left_out = count - most;
      lines.push_back(fmt::format("/* {} more commands */", left_out));
      i += left_out;
    }
    lines.push_back(to_c(commands[static_cast<std::size_t>(i)], most_elements));
  }
  return lines;
}

std::vector<std::string> all_calls(const Case& script, std::size_t most_lines, std::size_t most_elements) {
  return to_c(script, 0, static_cast<int>(script.commands().size()) - 1, most_lines, most_elements);
}

}  // namespace evalcts::gl
