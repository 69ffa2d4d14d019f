#include <render/render.h>
#include <render/render_job.h>

namespace render {

RenderResult render(const Scene& scene, const RenderOptions& options) {
  RenderJob job(scene, options);
  const bool is_done =
      mc::run_job(job, {options.threads, options.cancel, options.checkpoint, options.executor, options.name});
  return job.result(is_done);
}

} // namespace render
