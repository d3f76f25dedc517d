// A GL library as an implementation: loads its entry points into a table, and makes the contexts of cases
// with a ContextMaker.
#include <algorithm>
#include <initializer_list>
#include <map>
#include <string>
#include <utility>

#include "context_maker.h"
#include "shared_library.h"

namespace evalcts {
namespace {

class NoContexts final : public ContextMaker {
 public:
  std::string kind() const override { return "none"; }
  void* create() override { return nullptr; }
  void destroy(void*) override {}
  void* address_of(const char*) override { return nullptr; }
  std::string library() const override { return {}; }
};

// The initial context of a case, and the further contexts that the case makes.
class MadeContext final : public Context {
 public:
  MadeContext(ContextMaker& maker, void* handle, const gl::Table& table)
      : maker_(maker), handle_(handle), table_(table) {
    of_the_case_ = this;
  }
  ~MadeContext() override {
    of_the_case_ = nullptr;
    for (const auto& [number, handle] : others_) {
      maker_.make_current(handle);
      maker_.destroy(handle);
    }
    if (!others_.empty()) maker_.make_current(handle_);
    maker_.destroy(handle_);
  }
  MadeContext(const MadeContext&) = delete;
  MadeContext& operator=(const MadeContext&) = delete;

  const gl::Table& table() const override { return table_; }
  void make_current() override {
    of_the_case_ = this;
    maker_.make_current(handle_);
  }
  void release() override {
    of_the_case_ = nullptr;
    maker_.release();
  }

  // Implements the commands of gl/contexts.h.
  static void other(GLuint number) {
    of_the_case_->make_current(number, gl::EntryPoint::OtherContextEVALCTS,
                               [](ContextMaker& maker) { return maker.create(); });
  }
  static void sharing(GLuint number) {
    of_the_case_->make_current(number, gl::EntryPoint::SharingContextEVALCTS, [](ContextMaker& maker) {
      return maker.create_sharing(of_the_case_->handle_);
    });
  }
  static void of_kind(GLuint number, GLuint kind) {
    of_the_case_->make_current(number, gl::EntryPoint::ContextOfKindEVALCTS,
                               [kind](ContextMaker& maker) { return maker.create_of_kind(kind); });
  }

  static void copy(GLuint from, GLuint to, GLbitfield mask) {
    MadeContext& all = *of_the_case_;
    const auto handle = [&](GLuint number) {
      const auto made = all.others_.find(number);
      if (number != 0 && made == all.others_.end())
        throw gl::MissingEntryPoint(gl::EntryPoint::CopyContextEVALCTS);
      return number == 0 ? all.handle_ : made->second;
    };
    try {
      all.maker_.make_current(handle(from));
      all.maker_.copy(handle(from), handle(to), mask);
    } catch (const CannotStart& error) {
      throw NotObservable(std::string("pipeline: ") + error.what());
    }
  }

  // Implement the commands of gl/requests.h.
  static void record_requests() { of_the_case_->maker_.record_requests(); }
  static GLsizei recorded_requests(GLsizei size, GLubyte* requests) {
    const std::vector<unsigned char> all = of_the_case_->maker_.recorded_requests();
    std::copy_n(all.begin(), std::min(all.size(), static_cast<std::size_t>(std::max(size, 0))), requests);
    return static_cast<GLsizei>(all.size());
  }

 private:
  template <class Create>
  void make_current(GLuint number, gl::EntryPoint command, const Create& create) {
    if (number == 0) return maker_.make_current(handle_);
    if (const auto made = others_.find(number); made != others_.end())
      return maker_.make_current(made->second);
    try {
      others_[number] = create(maker_);
    } catch (const CannotStart&) {  // no second context, or no context of this kind, can be created
      others_.erase(number);
      throw gl::MissingEntryPoint(command);
    }
  }

  static inline thread_local MadeContext* of_the_case_ = nullptr;

  ContextMaker& maker_;
  void* handle_;
  std::map<GLuint, void*> others_;
  const gl::Table& table_;
};

class GlLibrary final : public Implementation {
 public:
  GlLibrary(std::string name, std::unique_ptr<ContextMaker> contexts, std::string library)
      : name_(std::move(name)), contexts_(std::move(contexts)), library_(std::move(library)) {}

  std::string name() const override { return name_; }
  std::string library() const override { return library_.empty() ? contexts_->library() : library_; }
  std::string context_kind() const override { return contexts_->kind(); }
  std::string context_library() const override { return library_.empty() ? "" : contexts_->library(); }

  std::unique_ptr<Context> create_context() override {
    auto context = std::make_unique<MadeContext>(*contexts_, contexts_->create(), table_);
    if (!loaded_) {
      load();
      context->make_current();  // a layer may have made another context current
    }
    return context;
  }

  std::unique_ptr<Context> create_beside() override {
    if (!contexts_->makes_several()) return nullptr;
    try {
      return create_context();
    } catch (const CannotStart&) {
      return nullptr;
    }
  }

 private:
  // Loads the library. A context is current then, because a layer may look for the context below it.
  void load() {
    if (library_.empty()) {
      const auto exported = [this](const char* command) { return contexts_->exported(command); };
      const auto address_of = [this](const char* command) { return contexts_->address_of(command); };
      table_ = gl::load_table({exported, address_of}, advertised_by({exported, address_of}));
    } else {
      const SharedLibrary library(library_);
      // Only symbols of the library itself are used, because its dependencies are not under test.
      const auto exported = [&](const char* command) { return library.exported(command); };
      table_ = gl::load_table({exported}, advertised_by({exported}));
      library_ = library.path();
    }
    if (contexts_->makes_several()) {
      table_.OtherContextEVALCTS = &MadeContext::other;
      table_.SharingContextEVALCTS = &MadeContext::sharing;
      table_.ContextOfKindEVALCTS = &MadeContext::of_kind;
    }
    if (contexts_->has_threads()) table_.MoveToThreadEVALCTS = [](GLuint) {};
    if (contexts_->copies()) table_.CopyContextEVALCTS = &MadeContext::copy;
    if (contexts_->records_requests()) {
      table_.RecordRequestsEVALCTS = &MadeContext::record_requests;
      table_.RecordedRequestsEVALCTS = &MadeContext::recorded_requests;
    }
    loaded_ = true;
  }

  // Returns the version and the extensions of the current context.
  static gl::Advertised advertised_by(std::initializer_list<gl::AddressOf> sources) {
    const auto find = [&]<class Command>(Command*& command, const char* name) {
      for (const gl::AddressOf& source : sources)
        if (!command) command = reinterpret_cast<Command*>(source(name));
    };
    decltype(&::glGetString) get_string = nullptr;
    decltype(&::glGetError) get_error = nullptr;
    find(get_string, "glGetString");
    find(get_error, "glGetError");
    if (!get_string) return {};
    const auto text = [&](GLenum name) {
      const GLubyte* const answer = get_string(name);
      return answer ? std::string(reinterpret_cast<const char*>(answer)) : std::string();
    };
    gl::Advertised advertised = gl::parse_advertised(text(GL_VERSION), text(GL_EXTENSIONS));
    if (get_error) get_error();  // a core profile has no GL_EXTENSIONS
    return advertised;
  }

  std::string name_;
  std::unique_ptr<ContextMaker> contexts_;
  std::string library_;
  gl::Table table_;
  bool loaded_ = false;
};

}  // namespace

std::unique_ptr<ContextMaker> make_no_contexts() { return std::make_unique<NoContexts>(); }

std::unique_ptr<Implementation> make_gl_library(const std::string& name,
                                                std::unique_ptr<ContextMaker> contexts,
                                                const std::string& library) {
  return std::make_unique<GlLibrary>(name, std::move(contexts), library);
}

}  // namespace evalcts
