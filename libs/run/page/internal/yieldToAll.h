#pragma once
namespace scanloom
{
/** The calling thread runs only where nothing else wants the processor (SCHED_IDLE; of this thread, not the program).
 */
void yieldToAll();
}  // namespace scanloom
