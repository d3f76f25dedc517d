// Implementations: the GL libraries and evaluators that can be judged, with their loading and their contexts.
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

// Thrown if the implementation cannot be judged; the message states the reason and what to do.
struct CannotStart : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A context, which is current from its creation. Destroying it leaves no context current.
class Context {
 public:
  virtual ~Context() = default;
  virtual const gl::Table& table() const = 0;
  // Runs the case on this context. Every case of a test or capture is run by this function.
  virtual gl::Trace play(const gl::Case& script);
  // Returns the shader programs that captures keep, by their source, if many cases share this context; null
  // for other contexts.
  virtual std::map<std::string, GLuint>* kept_programs() { return nullptr; }
  // Makes a context of create_beside(), or one that was released, current in the calling thread. Must not be
  // called while a case uses another context.
  virtual void make_current() {}
  // Leaves no context current in the calling thread, so that make_current() may be called in another one.
  // Called only if the table has MoveToThreadEVALCTS.
  virtual void release() {}
  // True if take_emitted() returns vertices directly from the evaluator (implementations in this process).
  virtual bool has_sink() const { return false; }
  // Returns the attributes of the vertices of take_emitted().
  virtual Attributes emitted_attributes() const { return kAllAttributes; }
  // Returns the primitives emitted since the last call, if has_sink().
  virtual std::vector<ObservedPrimitive> take_emitted() { return {}; }
};

// Features, besides commands, that an evaluator that is not a GL declares. Cases that use other features are
// not run.
struct Declaration {
  std::set<GLenum> targets;  // map targets and GL_AUTO_NORMAL; empty: all
  GLint max_order = 0;       // 0: the answer to GL_MAX_EVAL_ORDER
};
// Returns the undeclared feature that the command uses ("GL_MAP1_COLOR_4", "order 9"), or an empty string.
std::string undeclared_part(const Declaration& declaration, const gl::Command& command);

class Implementation {
 public:
  virtual ~Implementation() = default;
  virtual std::string name() const = 0;
  // Returns the file of the entry points; empty for built-in implementations.
  virtual std::string library() const { return {}; }
  // Return the kind of contexts for a C program (see CProgram::context), and the file that makes them if it
  // is not library().
  virtual std::string context_kind() const { return name(); }
  virtual std::string context_library() const { return {}; }
  // Returns the library that provides what library() lacks, which library() finds by the environment variable
  // GLEVALUATOR_GL; empty: none.
  virtual std::string library_below() const { return {}; }
  // Creates a fresh context. Throws CannotStart.
  virtual std::unique_ptr<Context> create_context() = 0;
  // Creates a context that may coexist with those of create_context() and is current after its creation.
  // Returns null if this is not supported.
  virtual std::unique_ptr<Context> create_beside() { return nullptr; }
  // Returns the declared features; null for a GL, which supports everything of its version.
  virtual const Declaration* declaration() const { return nullptr; }
};

// An implementation that wraps another one and forwards the functions that are not overridden.
class ImplementationInFront : public Implementation {
 public:
  explicit ImplementationInFront(Implementation& inner) : inner_(inner) {}  // must outlive the object
  explicit ImplementationInFront(std::unique_ptr<Implementation> inner)
      : owned_(std::move(inner)), inner_(*owned_) {}
  std::string name() const override { return inner_.name(); }
  std::string library() const override { return inner_.library(); }
  std::string context_kind() const override { return inner_.context_kind(); }
  std::string context_library() const override { return inner_.context_library(); }
  std::string library_below() const override { return inner_.library_below(); }
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
  // Maker of the contexts, instead of that of `name`: one of context_names(), or the path of a provider
  // (evalcts_provider.h). If `library` is set, all commands come from it. Empty: the usual maker.
  std::string context = {};
  std::string mesa_build =
      {};  // folder of a Mesa to use in place of the system's, see mesa_build.h; empty: none

  // Shell command that starts a worker, which opens the implementation where it runs (see Worker); empty: a
  // process of this machine.
  std::string worker = {};

  // Returns the name in results and file names: `name`, or "library".
  std::string label() const { return name.empty() ? "library" : name; }
  // Returns the options of a command that choose this implementation.
  std::vector<std::string> words() const;
};

struct ImplementationKind {
  std::string name;
  std::string what;
  std::string package;  // Debian package that it needs; empty: none
  bool by_default;      // true if `evalcts run` judges it by default
};

// Returns all kinds that open_implementation() supports.
const std::vector<ImplementationKind>& implementation_kinds();

// Returns the names that ImplementationOptions::context accepts.
const std::vector<std::string>& context_names();

// Opens an implementation and loads its library, if it has one. Throws CannotStart.
std::unique_ptr<Implementation> open_implementation(const ImplementationOptions& options);

// GetBooleanv, GetIntegerv, GetFloatv or GetDoublev of a name.
using RejectedQuery = std::pair<gl::EntryPoint, GLenum>;

// The answers of an implementation to queries about itself in a fresh context.
struct ImplementationInfo {
  std::string name, library, vendor, renderer, version;
  int major = 0, minor = 0;
  GLint max_eval_order = 0;  // 0: not answered
  GLint texture_units = 1;
  GLint active_units = 1;  // that ActiveTexture has to accept
  std::set<std::string> extensions;
  std::set<RejectedQuery> rejected_queries;  // see rejected_queries.h, as for the next one
  std::set<GLenum> rejected_grid_queries;
  std::optional<GLenum> idle_capability;   // see gl::find_idle_capability()
  bool is_in_front = false;                // in front of another GL, whose contexts it uses
  bool shares_state = false;               // state that one context sets is visible in the next one
  std::set<gl::EntryPoint> missing;        // the commands that it does not have
  std::optional<Declaration> declaration;  // set for an implementation that is not a GL
  bool no_error = false;  // a no-error context (KHR_no_error): errors are undefined behaviour

  // Returns the largest order that must be accepted: MAX_EVAL_ORDER up to 64, or 8 if the implementation
  // returns less (which EV-INIT-MAXORDER tests) or does not answer.
  int max_order() const { return std::clamp(max_eval_order, 8, 64); }

  // Returns 10 * major + minor.
  int version_number() const { return 10 * major + minor; }

  bool has(gl::EntryPoint command) const { return !missing.contains(command); }

  // Returns false if each form of Get rejects the name.
  bool answers(GLenum queried) const;

  bool at_least(int wanted_major, int wanted_minor) const {
    return major > wanted_major || (major == wanted_major && minor >= wanted_minor);
  }
};

// Queries the implementation and checks that evaluators have an effect, because an address alone proves
// nothing. Throws CannotStart.
ImplementationInfo inquire(Implementation& implementation);

}  // namespace evalcts
