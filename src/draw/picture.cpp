#include "draw/picture.h"

#include <algorithm>

#include "draw/caption.h"
#include "draw/layout.h"
#include "draw/panels.h"
#include "draw/sheet.h"

namespace palpation::draw {

std::string picture_of(const Outcome& outcome) {
  const PanelPlan plan = plan_of(outcome);
  const Layout layout = layout_of(outcome, plan.view, plan.close_up);
  Sheet sheet(layout.width_px, layout.height_px);
  draw_panel(sheet, outcome, plan, Panel::Mean, layout.maps[0], "a");
  draw_panel(sheet, outcome, plan, Panel::Uncertainty, layout.maps[1], "b");
  draw_panel(sheet, outcome, plan, Panel::Boundary,
             plan.third == Third::Band ? layout.close_up : layout.maps[2], "c");
  draw_legend(sheet, layout.legend, kCaption_px);
  const std::string caption = caption_of(outcome);
  TextStyle style{.size_px = 21.0, .bold = true, .horizontal = Horizontal::Centre};
  const double room_px = sheet.width_px() - 2.0 * kCaptionMargin_px;
  style.size_px *= std::min(1.0, room_px / text_width_px(caption, style));
  sheet.text({sheet.width_px() / 2.0, kCaption_px / 2.0 + 2.0}, caption, style);
  return sheet.png();
}

}  // namespace palpation::draw
