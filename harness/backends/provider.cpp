// Contexts from a provider, a shared library of the user.
#include <evalcts/gl/contexts.h>
#include <evalcts_provider.h>
#include <fmt/format.h>

#include "context_maker.h"
#include "shared_library.h"

namespace evalcts {
namespace {

class Provider final : public ContextMaker {
 public:
  explicit Provider(const std::string& path) : library_(path) {
    const auto open = library_.find_as<decltype(&evalcts_provider_open)>("evalcts_provider_open");
    if (!open)
      throw CannotStart(
          fmt::format("{} does not export evalcts_provider_open: it is not a provider of contexts, see "
                      "evalcts_provider.h",
                      library_.path()));
    provider_ = open();
    if (!provider_)
      throw CannotStart(fmt::format("evalcts_provider_open of {} returns null", library_.path()));
    if (provider_->version < 1 || provider_->version > EVALCTS_PROVIDER_VERSION)
      throw CannotStart(fmt::format(
          "{} was built for version {} of evalcts_provider.h, this evalcts knows versions 1 to {}: "
          "rebuild it",
          library_.path(), provider_->version, EVALCTS_PROVIDER_VERSION));
    if (!provider_->create || !provider_->destroy)
      throw CannotStart(fmt::format("{} lacks create or destroy", library_.path()));
  }

  std::string kind() const override { return "provider"; }
  void* create() override { return made_by(provider_->create); }
  bool makes_several() const override { return provider_->version >= 2 && provider_->make_current; }
  void* create_sharing(void* /*with*/) override {
    throw CannotStart("a provider makes no contexts that share objects");
  }
  void* create_of_kind(GLuint kind) override {
    if (kind != EVALCTS_COLOR_INDEX || !provider_->create_color_index)
      return ContextMaker::create_of_kind(kind);
    return made_by(provider_->create_color_index);
  }
  void make_current(void* context) override {
    if (makes_several() && !provider_->make_current(context))
      throw CannotStart(fmt::format("{} does not make its context current", library_.path()));
  }
  bool has_threads() const override {
    return makes_several() && provider_->version >= 3 && provider_->release;
  }
  void release() override { provider_->release(); }
  void destroy(void* context) override { provider_->destroy(context); }
  void* address_of(const char* command) override {
    return provider_->get_address ? provider_->get_address(command) : nullptr;
  }
  std::string library() const override { return library_.path(); }

 private:
  void* made_by(void* (*creator)()) const {
    if (void* context = creator()) return context;
    const char* error = provider_->error ? provider_->error() : nullptr;
    const std::string why = error ? error : "it gives no reason";  // a message of dlerror() is soon invalid
    throw CannotStart(fmt::format("{} cannot create a context: {}", library_.path(), why));
  }

  SharedLibrary library_;
  const evalcts_provider* provider_ = nullptr;
};

}  // namespace

std::unique_ptr<ContextMaker> load_provider(const std::string& path) {
  return std::make_unique<Provider>(path);
}

}  // namespace evalcts
