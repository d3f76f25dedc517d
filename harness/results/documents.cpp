// Finds the short names of documents in sources, and writes quotations. The addresses are those of the
// registry's index.
#include <evalcts/results/documents.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>

namespace evalcts {
namespace {

constexpr const char* kSpecifications = "https://registry.khronos.org/OpenGL/specs/gl/";
constexpr const char* kPages = "https://registry.khronos.org/OpenGL-Refpages/gl2.1/xhtml/";
constexpr const char* kExtensions = "https://registry.khronos.org/OpenGL/extensions/";
constexpr const char* kVendors[] = {"APPLE", "ARB", "EXT", "KHR", "NV", "OES", "REND", "SGIS", "SGIX"};

// Returns the version at the beginning of the text, "2.1" of "2.1 §5.1"; empty if there is none.
std::string version_at(const std::string& text) {
  constexpr const char* kDigits = "0123456789";
  if (text.find_first_of(kDigits) != 0 || text.find('.') != 1 || text.find_first_of(kDigits, 2) != 2)
    return {};
  return text.substr(0, 3);
}

Document specification(const std::string& version, bool core) {
  std::string file = "glspec" + version.substr(0, 1) + version.substr(2);
  if (version == "1.2") file += "1";
  if (version == "3.1") file += "undep";

  if (version >= "3.2") file += core ? ".core" : ".compatibility";
  return {"OpenGL " + version, kSpecifications + file + ".pdf"};
}

// Returns the document that a word names, given the next one.
std::optional<Document> named_by(const std::string& word, const std::string& next) {
  if (word.starts_with("gl") && word.size() > 2 && std::isupper(static_cast<unsigned char>(word[2])))
    return Document{"the reference page of " + word, kPages + word + ".xml"};
  if (word == "GLX" && next.starts_with("protocol"))
    return Document{"the GLX protocol", std::string(kSpecifications) + "glxencode1.3.pdf"};
  if (word == "GLX" && next.starts_with("1.4"))
    return Document{"GLX 1.4", std::string(kSpecifications) + "glx1.4.pdf"};
  if (word == "GLU" && next.starts_with("1.3"))
    return Document{"GLU 1.3", std::string(kSpecifications) + "glu1.3.pdf"};
  if (word == "gl.xml")
    return Document{"gl.xml", "https://github.com/KhronosGroup/OpenGL-Registry/blob/main/xml/gl.xml"};
  const std::string vendor = word.substr(0, word.find('_'));
  if (vendor != word && std::ranges::count(kVendors, vendor) != 0)
    return Document{"GL_" + word, fmt::format("{}{}/{}.txt", kExtensions, vendor, word)};
  return std::nullopt;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    if (c != ' ' && c != ';' && c != ',' && c != '(' && c != ')')
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  return words;
}

}  // namespace

std::string text_of(const Quote& quote) {
  return quote.text.empty() ? "" : fmt::format("“{}” ({})", quote.text, quote.source);
}

std::vector<Document> documents_in(const std::string& source) {
  std::vector<Document> found;
  const auto add = [&](const Document& document) {
    if (std::ranges::count(found, document) == 0) found.push_back(document);
  };
  const std::vector<std::string> words = words_of(source);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string next = i + 1 < words.size() ? words[i + 1] : "";
    if (words[i] == "GL" && !version_at(next).empty()) {
      const bool core = i + 2 < words.size() && words[i + 2] == "core";
      add(specification(version_at(next), core));
      const std::size_t dash = next.find('-');
      if (dash != std::string::npos && !version_at(next.substr(dash + 1)).empty())
        add(specification(version_at(next.substr(dash + 1)), core));
    } else if (const auto document = named_by(words[i], next)) {
      add(*document);
    }
  }
  return found;
}

}  // namespace evalcts
