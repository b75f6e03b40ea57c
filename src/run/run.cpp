#include "run/run.hpp"

#include "run/campaign.hpp"
#include "run/campaign_work.hpp"
#include "run/single.hpp"

namespace rsc {

long run_case(const Case& settings, const RunOptions& options) {
    if (settings.run.realizations == 1) return run_realization(settings, options).failed;
    CampaignWork work({settings}, options);
    ThreadTeam team(std::ref(work), settings.run.threads);
    return run_campaign(settings, options, team, 0, work.job(0)).failed;
}

}  // namespace rsc
