// Formats commands, arguments and constants as C. Long arrays are abbreviated in failure records.
#include <evalcts/gl/call_log.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <evalcts/gl/tokens.h>

namespace evalcts::gl {
namespace {

template <class T>
std::string constant(T value, const char* suffix) {
  if (std::isnan(value)) return "NAN";
  if (std::isinf(value)) return value > 0 ? "INFINITY" : "-INFINITY";
  // The shortest decimal that compilers round to the value. C does not accept "3f".
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + suffix;
}

// Returns the characters of a printable text, without the null character at its end; none for another array.
std::optional<std::string> text_of(const Input& input) {
  if (input.type != Scalar::kI8 || input.bytes.empty()) return std::nullopt;
  std::string text(reinterpret_cast<const char*>(input.bytes.data()), input.bytes.size());
  if (text.back() == '\0') text.pop_back();
  const bool is_printable = std::ranges::all_of(
      text, [](unsigned char c) { return (c >= ' ' && c <= '~') || c == '\n' || c == '\t'; });
  return is_printable ? std::optional(text) : std::nullopt;
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

constexpr std::size_t kLongestRun = 6;    // lines that repeat
constexpr std::size_t kFewestRounds = 4;  // of a loop

// Returns the number of times that the `length` lines at `begin` are repeated.
std::size_t rounds_at(const std::vector<std::string>& lines, std::size_t begin, std::size_t length) {
  const auto first = lines.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto step = static_cast<std::ptrdiff_t>(length);
  std::size_t rounds = 1;
  while (begin + (rounds + 1) * length <= lines.size() &&
         std::equal(first, first + step, first + step * static_cast<std::ptrdiff_t>(rounds)))
    ++rounds;
  return rounds;
}

// Returns the first and last lines with a comment between them if there are more than `most`.
std::vector<std::string> cut(std::vector<std::string> lines, std::size_t most) {
  if (lines.size() <= most) return lines;
  const std::size_t left_out = lines.size() - most;
  const auto middle = lines.begin() + static_cast<std::ptrdiff_t>(most / 2);
  lines.erase(middle, middle + static_cast<std::ptrdiff_t>(left_out));
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(most / 2),
               fmt::format("/* {} more lines */", left_out));
  return lines;
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
    std::string text = "(const GLchar *[]){";
    for (std::size_t i = 0; i < strings->values.size(); ++i)
      text += (i ? ", " : "") + quoted(strings->values[i]);
    return text + "}";
  }
  const Input& input = std::get<Input>(value);
  return literal_of(input, most_elements) + after_call(input.after);
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
    if (c == '\t') {
      out += "\\t";
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

std::string literal_of(const Input& input, std::size_t most_elements) {
  if (const std::optional<std::string> text = text_of(input)) return quoted(*text);
  return fmt::format("({}[]){{{}}}", c_type(input.type), elements_of(input, most_elements));
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

std::vector<std::string> with_loops(const std::vector<std::string>& lines) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < lines.size();) {
    std::size_t length = 1;
    while (length <= kLongestRun && rounds_at(lines, i, length) < kFewestRounds) ++length;
    if (length > kLongestRun) {
      out.push_back(lines[i++]);
      continue;
    }
    const std::size_t rounds = rounds_at(lines, i, length);
    out.push_back(fmt::format("for (int i = 0; i < {}; ++i){}", rounds, length > 1 ? " {" : ""));
    for (std::size_t k = 0; k < length; ++k) out.push_back("  " + lines[i + k]);
    if (length > 1) out.emplace_back("}");
    i += rounds * length;
  }
  return out;
}

std::vector<std::string> program_of(const Case& script, std::size_t most_lines) {
  return cut(with_loops(all_calls(script, script.commands().size())), most_lines);
}

}  // namespace evalcts::gl
