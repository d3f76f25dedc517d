// Evaluators that are no GL, from a shared library of the user's.
#include <evalcts_sink.h>
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "kinds.h"
#include "shared_library.h"

namespace evalcts {
namespace {

static_assert(EVALCTS_SINK_POSITION == kPosition && EVALCTS_SINK_COLOR == kColor &&
              EVALCTS_SINK_NORMAL == kNormal && EVALCTS_SINK_TEXCOORD == kTextureCoordinate0 &&
              EVALCTS_SINK_TEXCOORD_OTHER == kTextureCoordinatesOther && EVALCTS_SINK_ALL == kAllAttributes);

// What the entry point GetString answers for; the others find their context by themselves.
const evalcts_sink* described = nullptr;

const GLubyte* get_string(GLenum name) {
  const auto text = [](const char* words) { return reinterpret_cast<const GLubyte*>(words ? words : ""); };
  switch (name) {
    case GL_VENDOR:
      return text(described->vendor);
    case GL_RENDERER:
      return text(described->name);
    case GL_VERSION:
      return text(described->gl_version);
    default:
      return text("");
  }
}

class SinkContext final : public Context {
 public:
  SinkContext(const evalcts_sink& sink, const gl::Table& table, const std::string& library)
      : sink_(sink), table_(table) {
    receiver_.user = this;
    receiver_.begin = [](void* self, unsigned mode) { static_cast<SinkContext*>(self)->begin(mode); };
    receiver_.end = [](void* self) { static_cast<SinkContext*>(self)->open_ = false; };
    receiver_.vertex = [](void* self, const float* position, const float* color, const float* normal,
                          const float(*texcoord)[4], unsigned units) {
      static_cast<SinkContext*>(self)->keep(position, color, normal, texcoord, units);
    };
    context_ = sink_.create(&receiver_);
    if (context_) return;
    const char* why = sink_.error ? sink_.error() : nullptr;
    throw CannotStart(fmt::format("{} makes no context: {}", library, why ? why : "it does not say why"));
  }
  ~SinkContext() override { sink_.destroy(context_); }
  SinkContext(const SinkContext&) = delete;
  SinkContext& operator=(const SinkContext&) = delete;

  const gl::Table& table() const override { return table_; }
  bool has_sink() const override { return true; }
  Attributes emitted_attributes() const override { return sink_.attributes; }
  std::vector<ObservedPrimitive> take_emitted() override { return std::exchange(emitted_, {}); }

 private:
  void begin(GLenum mode) {
    emitted_.push_back({mode, {}});
    open_ = true;
  }

  void keep(const float* position, const float* color, const float* normal, const float (*texcoord)[4],
            std::size_t units) {
    if (!open_) begin(GL_POINTS);  // not a place for vertices; the judge counts them
    ObservedVertex& vertex = emitted_.back().vertices.emplace_back();
    if (position) std::copy_n(position, 4, vertex.position.begin());
    if (color) std::copy_n(color, 4, vertex.color.begin());
    if (normal) std::copy_n(normal, 3, vertex.normal.begin());
    for (std::size_t unit = 0; texcoord && unit < std::min(units, kTextureUnits); ++unit)
      std::copy_n(texcoord[unit], 4, vertex.texture_coordinate[unit].begin());
  }

  const evalcts_sink& sink_;
  const gl::Table& table_;
  evalcts_receiver receiver_{};
  void* context_ = nullptr;
  std::vector<ObservedPrimitive> emitted_;
  bool open_ = false;
};

class SinkLibrary final : public Implementation {
 public:
  explicit SinkLibrary(const std::string& path) : library_(path) {
    const auto open = library_.find_as<decltype(&evalcts_sink_open)>("evalcts_sink_open");
    if (!open)
      throw CannotStart(fmt::format("{} exports no evalcts_sink_open, see evalcts_sink.h", library_.path()));
    sink_ = open();
    if (!sink_) throw CannotStart(fmt::format("evalcts_sink_open of {} returns null", library_.path()));
    if (sink_->version != EVALCTS_SINK_VERSION)
      throw CannotStart(fmt::format(
          "{} was built for version {} of evalcts_sink.h, this evalcts knows version {}: build it anew",
          library_.path(), sink_->version, EVALCTS_SINK_VERSION));
    if (!sink_->create || !sink_->destroy || !sink_->command)
      throw CannotStart(fmt::format("{} lacks create, destroy or command", library_.path()));
    table_ = gl::load_table({[this](const char* command) { return sink_->command(command); }});
    described = sink_;
    if (!table_.GetString) table_.GetString = get_string;
  }

  std::string name() const override { return "sink"; }
  std::string library() const override { return library_.path(); }
  std::unique_ptr<Context> create_context() override {
    return std::make_unique<SinkContext>(*sink_, table_, library_.path());
  }

 private:
  SharedLibrary library_;
  const evalcts_sink* sink_ = nullptr;
  gl::Table table_;
};

}  // namespace

std::unique_ptr<Implementation> open_sink(const std::string& path) {
  if (path.empty())
    throw CannotStart(
        "it needs --library with a shared library that exports evalcts_sink_open, see evalcts_sink.h");
  return std::make_unique<SinkLibrary>(path);
}

}  // namespace evalcts
