// The documents that the sources of requirements name, and sentences that are quoted from them.
#pragma once

#include <string>
#include <vector>

namespace evalcts {

struct Document {
  std::string name;     // "OpenGL 2.1", "the reference page of glMap1", "GL_NV_evaluators"
  std::string address;  // in the registry of Khronos

  bool operator==(const Document&) const = default;
};

// A sentence or a piece of code of a document, word for word.
struct Quote {
  std::string text;
  std::string source;  // the document and the section, "GL 2.1 §5.1" or "glMap1 page"
};

// Returns "“text” (source)"; empty if nothing is quoted.
std::string text_of(const Quote& quote);

// Returns the documents that a source such as "GL 1.0-2.1 §5.1; glMap1 page; NV_evaluators errors" names,
// each once, in their order: of a range of versions the first and the last one. Versions from 3.1 on are
// those of the compatibility profile, unless the source says "core".
std::vector<Document> documents_in(const std::string& source);

}  // namespace evalcts
