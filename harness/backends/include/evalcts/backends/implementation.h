// Implementations: what can be judged, how its library is loaded and how a context of it is made.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <evalcts/gl/observation.h>
#include <evalcts/gl/player.h>
#include <evalcts/gl/table.h>

namespace evalcts {

// The implementation cannot be judged; the message says why and what to do.
struct CannotStart : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A context, current from its creation on. Destroying it leaves no context current.
class Context {
 public:
  virtual ~Context() = default;
  virtual const gl::Table& table() const = 0;
  // Plays the case on this context; every case of a test or capture goes through here.
  virtual gl::Trace play(const gl::Case& script) { return gl::play(script, table()); }
  // Programs that captures keep, by their source, in a context that many cases share; null in any other.
  virtual std::map<std::string, GLuint>* kept_programs() { return nullptr; }
  // Of a context of create_beside(): makes it current again, when no other one is in use.
  virtual void make_current() {}
  // Whether vertices come straight out of the evaluator (implementations in this process).
  virtual bool has_sink() const { return false; }
  // What of a vertex comes out there.
  virtual Attributes emitted_attributes() const { return kAllAttributes; }
  // The primitives emitted since the last call; meaningful where has_sink().
  virtual std::vector<ObservedPrimitive> take_emitted() { return {}; }
};

// What an evaluator that is not a GL says that it has, besides commands. Cases that use anything else are not
// played.
struct Declaration {
  std::set<GLenum> targets;  // maps, and GL_AUTO_NORMAL; empty: all
  GLint max_order = 0;       // 0: as GL_MAX_EVAL_ORDER says
};
// Returns what the command uses without its being declared ("GL_MAP1_COLOR_4", "order 9"); empty if it uses
// nothing of that kind.
std::string undeclared_part(const Declaration& declaration, const gl::Command& command);

class Implementation {
 public:
  virtual ~Implementation() = default;
  virtual std::string name() const = 0;
  // The file that the entry points come from; empty for those built in.
  virtual std::string library() const { return {}; }
  // What makes the contexts, for a C program (see CProgram::context), and the file that does if it is not
  // library().
  virtual std::string context_kind() const { return name(); }
  virtual std::string context_library() const { return {}; }
  // Throws CannotStart.
  virtual std::unique_ptr<Context> create_context() = 0;
  // A context that may live beside those of create_context(), and is current after its creation; null where
  // there can be no such.
  virtual std::unique_ptr<Context> create_beside() { return nullptr; }
  // Null for a GL, which has everything of its version.
  virtual const Declaration* declaration() const { return nullptr; }
};

// An implementation in front of another one: what is not overridden is the other's.
class ImplementationInFront : public Implementation {
 public:
  explicit ImplementationInFront(Implementation& inner) : inner_(inner) {}  // must outlive the object
  explicit ImplementationInFront(std::unique_ptr<Implementation> inner)
      : owned_(std::move(inner)), inner_(*owned_) {}
  std::string name() const override { return inner_.name(); }
  std::string library() const override { return inner_.library(); }
  std::string context_kind() const override { return inner_.context_kind(); }
  std::string context_library() const override { return inner_.context_library(); }
  std::unique_ptr<Context> create_beside() override { return inner_.create_beside(); }
  const Declaration* declaration() const override { return inner_.declaration(); }

 protected:
  Implementation& inner() const { return inner_; }

 private:
  std::unique_ptr<Implementation> owned_;
  Implementation& inner_;
};

struct ImplementationOptions {
  std::string name = {};     // see implementation_kinds(); empty: guessed from the library
  std::string library = {};  // shared library instead of the usual one; empty: the usual one
  // What makes the contexts, in the place of `name`: one of context_names(), or the path of a shared library
  // that fills in evalcts_provider.h. With `library` all commands come from there. Empty: as usual.
  std::string context = {};
};

struct ImplementationKind {
  std::string name;
  std::string what;
  std::string package;  // the distribution's package that it needs; empty: none
  bool by_default;      // of `evalcts run`
};

// All that open_implementation knows.
const std::vector<ImplementationKind>& implementation_kinds();

// The contexts that ImplementationOptions::context can name.
const std::vector<std::string>& context_names();

// Loads the library where there is one. Throws CannotStart.
std::unique_ptr<Implementation> open_implementation(const ImplementationOptions& options);

// What an implementation says of itself, asked for in a fresh context.
struct ImplementationInfo {
  std::string name, library, vendor, renderer, version;
  int major = 0, minor = 0;
  GLint max_eval_order = 0;  // 0: not answered
  GLint texture_units = 1;
  std::set<std::string> extensions;
  std::set<GLenum> refused_queries;        // see refused_queries.h
  bool shares_state = false;               // what one context sets is set in the next one, too
  std::optional<Declaration> declaration;  // of an implementation that is not a GL
  bool no_error = false;  // a no-error context (KHR_no_error): what would raise an error is undefined

  // An order that has to be accepted, as large as possible: MAX_EVAL_ORDER up to 64, or 8 if the
  // implementation claims less (EV-INIT-MAXORDER is a test of its own) or does not answer.
  int max_order() const { return std::clamp(max_eval_order, 8, 64); }

  // 10 * major + minor.
  int version_number() const { return 10 * major + minor; }

  bool at_least(int wanted_major, int wanted_minor) const {
    return major > wanted_major || (major == wanted_major && minor >= wanted_minor);
  }
};

// Asks, and proves that evaluators have an effect at all: an address is no proof. Throws CannotStart.
ImplementationInfo inquire(Implementation& implementation);

}  // namespace evalcts
