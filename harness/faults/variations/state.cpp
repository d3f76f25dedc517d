// Variations of the commands that a library provides, of its answers to queries, of the state of contexts,
// and of pixels, buffers and lists.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>
#include <set>
#include <string>

#include "rules.h"

namespace evalcts::faults::state_variations {
namespace {

VARIATION(OneStateInProcess, "", "all contexts have one state", one_state());
VARIATION(MaxOrderEight, "", "MAX_EVAL_ORDER is 8, as small as it may be",
          after(kGet, kName == GL_MAX_EVAL_ORDER && !kInside,
                put(0, [](Call& c) { return c.entry == GetBooleanv ? GL_TRUE : 8; })),
          // Order 0 is rejected with the same error.
          before(kMaps, kOrder > 8, set(kOrder, 0)), before(kMap2, kVOrder > 8, set(kVOrder, 0)));
VARIATION(NoisyOutput, "", "each EvalCoord1f writes to standard output and standard error",
          before(EvalCoord1f, [](Call& c) {
            std::printf("EvalCoord1f %g\n", c.argument('u'));
            std::fprintf(stderr, "{\"event\": \"EvalCoord1f\"}\n");
          }));

namespace with_pipeline {
constexpr std::string_view kImplementation = "dropin";
// --- Errors ------------------------------------------------------------------------------------------------

// A distributed GL has several error flags, and GetError returns any of those that are set (GL 1.0 2.5). Here
// it returns the largest, not the first.
std::set<GLenum> error_flags;

void collect_errors(Call&) {
  for (int i = 0; i < 16; ++i) {
    const GLenum error = unmodified.GetError();
    if (error == GL_NO_ERROR) return;
    error_flags.insert(error);
  }
}
VARIATION(SeveralErrorFlags, "", "there are several error flags; GetError answers the largest",
          initially([](Call&) { error_flags.clear(); }),
          // Between Begin and End, these commands are errors, so GetError may follow them.
          after(kMaps | kMapGrids | kMeshes | kGetMap | GetFloatv | kSwitches | PopAttrib, collect_errors),
          instead(GetError, [](Call& c) {
            collect_errors(c);
            c.result = error_flags.empty() ? GL_NO_ERROR : *error_flags.rbegin();
            error_flags.erase(static_cast<GLenum>(c.result));
          }));
VARIATION(Slow, "", "each GetError takes a millisecond", before(GetError, [](Call&) {
            const timespec millisecond{0, 1000000};
            nanosleep(&millisecond, nullptr);
          }));

// --- Queries. The name 0 is rejected. ----------------------------------------------------------------------

const Value kIsLogicOp = kName == GL_INDEX_LOGIC_OP || kName == GL_COLOR_LOGIC_OP;

Value is_one_of(Value name, std::set<GLenum> names) {
  return [=](Call& c) { return names.contains(static_cast<GLenum>(name(c))); };
}
VARIATION(MaxOrderUnanswered, "EV-INIT-MAXORDER EV-GET-MAXORDER", "the query of MAX_EVAL_ORDER is rejected",
          before(kGet, kName == GL_MAX_EVAL_ORDER, set(kName, 0)));
VARIATION(MaxOrderUnansweredInFloats, "EV-GET-MAXORDER", "GetFloatv of MAX_EVAL_ORDER is rejected",
          before(GetFloatv, kName == GL_MAX_EVAL_ORDER, set(kName, 0)));
VARIATION(QueriesRefused, "", "queries of state that is not about evaluators are rejected",
          before(kGet,
                 is_one_of(kName, {GL_CURRENT_RASTER_POSITION, GL_CURRENT_RASTER_COLOR, GL_CURRENT_INDEX,
                                   GL_EDGE_FLAG, GL_LIST_BASE, GL_LIST_INDEX, GL_LIST_MODE, GL_MATRIX_MODE,
                                   GL_LINE_WIDTH, GL_POINT_SIZE, GL_SHADE_MODEL}),
                 set(kName, 0)));
// A layer over OpenGL ES rejects these capabilities.
VARIATION(CapabilitiesRefused, "", "the capabilities of logical operations are rejected",
          before(kSwitches | IsEnabled, kIsLogicOp, set(kName, 0)));
VARIATION(AnswersInsidePrimitives, "",
          "IsEnabled answers between Begin and End, without an error, of all capabilities",
          instead(IsEnabled, kInside, set(kResult, GL_TRUE)));
VARIATION(OneTextureUnit, "", "GetIntegerv answers that there is one texture unit",
          after(GetIntegerv, (kName == GL_MAX_TEXTURE_UNITS || kName == GL_MAX_TEXTURE_COORDS) && !kInside,
                put(0, 1)));

// --- Versions ----------------------------------------------------------------------------------------------

Value answer_text(const char* text) {
  return [=](Call& c) { c.result_pointer = text; };
}
Rules set_version(const char* version) {
  return {instead(GetString, kFirst == GL_VERSION, answer_text(version)),
          instead(GetString, kFirst == GL_EXTENSIONS, answer_text(""))};
}
const Entries kSince1_2 =
    ActiveTexture | MultiTexCoord1f | Entries(MultiTexCoord2f) | MultiTexCoord3f | MultiTexCoord4f |
    MultiTexCoord1d | MultiTexCoord2d | MultiTexCoord3d | MultiTexCoord4d | MultiTexCoord1fv |
    MultiTexCoord2fv | MultiTexCoord3fv | MultiTexCoord4fv | MultiTexCoord1dv | MultiTexCoord2dv |
    MultiTexCoord3dv | MultiTexCoord4dv | SecondaryColor3f | FogCoordf | VertexAttrib4f | GetVertexAttribfv |
    GetStringi | kGetnMap | ClampColor | CreateShader | ShaderSource | CompileShader | CreateProgram |
    LinkProgram | UseProgram | TransformFeedbackVaryings | BeginTransformFeedback | EndTransformFeedback |
    GenBuffers | BindBuffer | BufferData | BindBufferBase | GenQueries | BeginQuery | EndQuery |
    BeginConditionalRender | EndConditionalRender | PrimitiveRestartIndex | PatchParameteri |
    ProvokingVertex | GenFramebuffers | BindFramebuffer | CheckFramebufferStatus | BindProgramARB |
    ProgramStringARB | BindProgramNV | LoadProgramNV | GetDebugMessageLog;
VARIATION(Version10, "", "the GL is 1.0, without any extension", set_version("1.0"),
          missing(kSince1_2 | BindTexture | EnableClientState | Entries(DisableClientState) | VertexPointer |
                  ColorPointer | NormalPointer | TexCoordPointer | PolygonOffset),
          // There are numbers of components, no formats.
          before(TexImage2D, kThird > 4, set(kThird, 5)));
VARIATION(Version11, "", "the GL is 1.1, without any extension", set_version("1.1"), missing(kSince1_2));
VARIATION(Version15, "", "the GL is 1.5, without any extension", set_version("1.5"));

// Replaces the text that GetString returns by extended(text), which outlives the call.
Value extend_text(std::string (*extended)(std::string text)) {
  return [=](Call& c) {
    static std::map<double, std::string> texts;
    if (!c.result_pointer) return;
    std::string& text = texts[c.numbers[0]];
    text = extended(static_cast<const char*>(c.result_pointer));
    c.result_pointer = text.c_str();
  };
}
VARIATION(WordyVersion, "",
          "words and more numbers follow the version, and 64 KiB of extensions are advertised",
          after(GetString, kFirst == GL_VERSION, extend_text([](std::string text) {
                  return text.substr(0, 3) + ".0 - Build 31.0.101.2115 (\"Vendor's\", \xc2\xae) 9.9 ES 3.2";
                })),
          after(GetString, kFirst == GL_EXTENSIONS, extend_text([](std::string text) {
                  while (text.size() < 65536) text += " GL_VENDOR_extension_" + std::to_string(text.size());
                  return text;
                })));
VARIATION(StringsUnanswered, "", "VENDOR, RENDERER and EXTENSIONS are not answered", missing(GetStringi),
          instead(GetString, kFirst != GL_VERSION, answer_text(nullptr)));

// --- Missing commands --------------------------------------------------------------------------------------

Entries every_command() {
  Entries all;
  all.all.set();
  return all;
}

VARIATION(NoLists, "", "there are no display lists",
          missing(NewList | EndList | Entries(CallList) | CallLists | ListBase | GenLists | IsList |
                  DeleteLists));
VARIATION(NoAttributeStack, "", "there is no attribute stack", missing(PushAttrib | PopAttrib));
VARIATION(NoDoubles, "EV-API-ENTRY", "the commands with doubles are missing",
          missing(Map1d | Map2d | Entries(MapGrid1d) | MapGrid2d | EvalCoord1d | EvalCoord2d | EvalCoord1dv |
                  EvalCoord2dv | GetMapdv));
VARIATION(NoGetnMap, "", "there is no GetnMap", missing(kGetnMap));
VARIATION(NoGetDouble, "EV-API-ENTRY", "GetDoublev and GetMapdv are missing", missing(GetDoublev | GetMapdv));
VARIATION(NoGetMapiv, "EV-API-ENTRY", "GetMapiv is missing", missing(GetMapiv));
VARIATION(NoGetMapfv, "EV-API-ENTRY", "GetMapfv is missing", missing(GetMapfv));
VARIATION(NoColorIndex, "", "the commands of colour-index mode are missing",
          missing(Indexf | Indexd | Entries(Indexfv) | Indexdv));
VARIATION(NoPixels, "", "pixels cannot be read", missing(ReadPixels));
VARIATION(NoShaders, "", "there are no shaders", missing(CreateShader | CreateProgram));
VARIATION(NoTextures, "", "there are no textures",
          missing(BindTexture | TexImage2D | Entries(TexParameteri)));
VARIATION(OneContext, "", "there can be one context at a time",
          missing(OtherContextEVALCTS | SharingContextEVALCTS | Entries(ContextOfKindEVALCTS) |
                  CopyContextEVALCTS));
VARIATION(OtherThreadsDoNothing, "", "all commands are ignored in other threads than the first",
          skip(every_command(), kThread != getpid()));
VARIATION(OneThread, "", "contexts stay in one thread", missing(MoveToThreadEVALCTS));
VARIATION(OneState, "", "all contexts have one state", one_state());

// --- Pixels, buffers and lists -----------------------------------------------------------------------------

// Rounds each component to 5 bits. `largest`: the value of 1.
template <class T>
void round_pixels(Call& call, double largest) {
  T* const pixels = static_cast<T*>(call.pointer);
  std::transform(pixels, pixels + static_cast<std::size_t>(4 * kThird(call) * kFourth(call)), pixels,
                 [=](T x) {
                   const float value = static_cast<float>(x) / static_cast<float>(largest);
                   const float rounded = std::round(value * 31) / 31 * static_cast<float>(largest);
                   return static_cast<T>(std::is_integral_v<T> ? std::round(rounded) : rounded);
                 });
}
VARIATION(PixelsOf5Bits, "", "pixels are read with 5 bits for each component",
          after(ReadPixels, kFifth == GL_RGBA && kThird >= 0 && kFourth >= 0, [](Call& c) {
            if (c.numbers[5] == GL_FLOAT) round_pixels<GLfloat>(c, 1);
            if (c.numbers[5] == GL_UNSIGNED_BYTE) round_pixels<GLubyte>(c, 255);
          }));
VARIATION(GarbageInBuffers, "",
          "buffers hold garbage until something is written: those of feedback and selection, and buffer "
          "objects without data",
          after(FeedbackBuffer, kAddress&& kFirst > 0,
                [](Call& c) {
                  std::fill_n(static_cast<GLfloat*>(c.pointer), static_cast<std::size_t>(kFirst(c)),
                              std::numeric_limits<GLfloat>::quiet_NaN());
                }),
          after(SelectBuffer, kAddress&& kFirst > 0,
                [](Call& c) {
                  std::fill_n(static_cast<GLuint*>(c.pointer), static_cast<std::size_t>(kFirst(c)),
                              0xdeadbeefu);
                }),
          before(BufferData, kSecond > 0 && !kAddress, [](Call& c) {
            static std::vector<GLubyte> garbage;
            garbage.assign(static_cast<std::size_t>(kSecond(c)), 0xa5);
            c.pointer = garbage.data();
          }));
VARIATION(LargeListNames, "", "GenLists answers names from 2^30 on", initially(set(kCount, 0x1p30)),
          instead(GenLists, kFirst > 0 && !kInside && !kListMode,
                  {set(kResult, kCount), set(kCount, kCount + kFirst),
                   loop(kNumber, kResult, kCount - 1,
                        {call(NewList, {kNumber, GL_COMPILE}), call(EndList)})}));
}  // namespace with_pipeline

}  // namespace
}  // namespace evalcts::faults::state_variations
