//! Making the stages, and keeping them for the next request.

use std::collections::{BTreeMap, VecDeque};
use std::fmt;
use std::sync::Arc;

use super::analysed::{self, Analysed};
use super::bounds::Bounds;
use super::outfitted::{self, Outfitted};
use super::proven::{self, Proven};
use super::revision::{Revision, Settled, settled};
use super::sized::{self, Sized};
use super::toothed::{self, Toothed};
use super::wanted::{self, Wanted};
use super::{DesignOptions, PipelineError, Request, ToothCount};
use crate::control::{Control, StageName};
use crate::diagnose::{Diagnostic, Verdict};
use crate::fit::Fitter;
use crate::meshing::DynamicsOptions;

/// Results of one stage that are kept: the attempts of one request with its repairs, and a request or two before it. Runs
/// weigh megabytes.
const KEPT: usize = 8;

/// One stage as it was made.
#[derive(Clone, Debug)]
pub enum Stage {
    /// See [`Wanted`].
    Wanted(Arc<Wanted>),
    /// See [`Sized`].
    Sized(Arc<Sized>),
    /// See [`Toothed`].
    Toothed(Arc<Toothed>),
    /// See [`Analysed`].
    Analysed(Arc<Analysed>),
    /// See [`Proven`].
    Proven(Arc<Proven>),
    /// See [`Outfitted`].
    Outfitted(Arc<Outfitted>),
}

impl Stage {
    /// Which it is.
    #[must_use]
    pub fn name(&self) -> StageName {
        match self {
            Self::Wanted(_) => StageName::Wanted,
            Self::Sized(_) => StageName::Sized,
            Self::Toothed(_) => StageName::Toothed,
            Self::Analysed(_) => StageName::Analysed,
            Self::Proven(_) => StageName::Proven,
            Self::Outfitted(_) => StageName::Outfitted,
        }
    }

    /// What it found out.
    #[must_use]
    pub fn diagnostics(&self) -> &[Diagnostic] {
        match self {
            Self::Wanted(stage) => &stage.diagnostics,
            Self::Sized(stage) => &stage.diagnostics,
            Self::Toothed(stage) => &stage.diagnostics,
            Self::Analysed(stage) => &stage.diagnostics,
            Self::Proven(stage) => &stage.diagnostics,
            Self::Outfitted(stage) => &stage.diagnostics,
        }
    }
}

/// What a request led to, as far as it was asked for.
#[derive(Clone, Debug)]
pub struct Stages {
    /// What was asked.
    pub asked: Request,
    /// The options that were used: the number of teeth that was chosen, and the bounds that repairs led to.
    pub used: DesignOptions,
    /// The repairs that were tried.
    pub revisions: Vec<Revision>,
    /// The motion.
    pub wanted: Arc<Wanted>,
    /// Pitch curves, if they were asked for; and so on.
    pub sized: Option<Arc<Sized>>,
    /// Outlines.
    pub toothed: Option<Arc<Toothed>>,
    /// Contact.
    pub analysed: Option<Arc<Analysed>>,
    /// Runs.
    pub proven: Option<Arc<Proven>>,
    /// The finished pair.
    pub outfitted: Option<Arc<Outfitted>>,
}

impl Stages {
    /// All that was found out, in the order of the stages; repairs that were taken are notes among them.
    #[must_use]
    pub fn diagnostics(&self) -> Vec<Diagnostic> {
        let mut found = self.wanted.diagnostics.clone();
        found.extend(self.revisions.iter().filter(|r| r.taken).map(|r| r.note.clone()));
        found.extend(self.sized.iter().flat_map(|s| s.diagnostics.iter().cloned()));
        found.extend(self.toothed.iter().flat_map(|s| s.diagnostics.iter().cloned()));
        found.extend(self.analysed.iter().flat_map(|s| s.diagnostics.iter().cloned()));
        found.extend(self.proven.iter().flat_map(|s| s.diagnostics.iter().cloned()));
        found.extend(self.outfitted.iter().flat_map(|s| s.diagnostics.iter().cloned()));
        crate::diagnose::once_each(found)
    }

    /// The same finished pair run again, as other runs ask; its gears and what was found of them before stay. None before
    /// the last stage.
    ///
    /// # Errors
    /// [`PipelineError::Dynamics`], [`PipelineError::Cancelled`].
    pub fn run_again(
        &self,
        runs: Vec<DynamicsOptions>,
        control: &Control,
    ) -> Result<Option<Self>, PipelineError> {
        let Some(outfitted) = &self.outfitted else { return Ok(None) };
        let options = DesignOptions { runs, ..self.asked.options.clone() };
        let analysed = &outfitted.proven.analysed;
        let proven = control.run(|| proven::Part::of(&options).run(analysed, control))?;
        let proven = Arc::new(proven);
        let outfitted = Outfitted { proven: proven.clone(), ..Outfitted::clone(outfitted) };
        let (proven, outfitted) = (Some(proven), Some(Arc::new(outfitted)));
        Ok(Some(Self { proven, outfitted, ..self.clone() }))
    }

    /// The verdict on what has been made.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        Verdict::of(&self.diagnostics())
    }
}

type Watcher = Arc<dyn Fn(&Stage) + Send + Sync>;

/// Makes stages, and keeps those of the last requests: a new bore makes the last stage alone, a new clearance keeps fit and
/// pitch curves, a new balance keeps the scan of both shapes.
///
/// ```
/// use centrode::control::{Control, StageName};
/// use centrode::law::{LawOptions, Preset};
/// use centrode::pipeline::{Request, Session};
///
/// let motion = Preset::Ellipse(0.3).transmission(&LawOptions::default())?;
/// let request = Request::motion(motion, ["ellipse", "its twin"].map(str::to_owned));
/// let mut session = Session::new();
/// let made = session.run(&request, StageName::Sized, &Control::new())?;
/// assert!(made.sized.is_some_and(|sized| sized.module > 0.0) && made.toothed.is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Default)]
pub struct Session {
    wanted: Memo<wanted::Part, Wanted>,
    sized: Memo<(Same<Wanted>, sized::Part), Sized>,
    toothed: Memo<(Same<Sized>, toothed::Part), Toothed>,
    analysed: Memo<(Same<Toothed>, analysed::Part), Analysed>,
    proven: Memo<(Same<Analysed>, proven::Part), Proven>,
    outfitted: Memo<(Same<Proven>, outfitted::Part), Outfitted>,
    settled: Memo<Settling, Settled>,
    fitter: Fitter,
    made: BTreeMap<StageName, usize>,
    watcher: Option<Watcher>,
}

/// All that decides which pair the repairs settle on.
#[derive(Clone, Debug, PartialEq)]
struct Settling {
    wanted: wanted::Part,
    sized: sized::Part,
    toothed: toothed::Part,
    limits: crate::diagnose::Limits,
    /// None where the pair is not proven.
    proven: Option<proven::Part>,
    repair: bool,
    quick: bool,
}

impl fmt::Debug for Session {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Session").field("made", &self.made).finish_non_exhaustive()
    }
}

impl Session {
    /// A session that has made nothing yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The same with a watcher that is told of every stage as soon as it stands, also of attempts that a repair replaces
    /// later and of stages kept from earlier requests. The last stage of each kind that it hears of is the one that
    /// is delivered.
    #[must_use]
    pub fn watched_by(self, watcher: impl Fn(&Stage) + Send + Sync + 'static) -> Self {
        Self { watcher: Some(Arc::new(watcher)), ..self }
    }

    /// How often a stage was made, not taken from an earlier request.
    #[must_use]
    pub fn made(&self, stage: StageName) -> usize {
        self.made.get(&stage).copied().unwrap_or_default()
    }

    /// Makes what was asked for as far as `until`. Up to [`StageName::Toothed`] that is the first attempt; repairs begin
    /// with the analysis.
    ///
    /// # Errors
    /// See [`PipelineError`]. A pair that is made but fails is no error: its diagnostics say so. After an error, and
    /// after a cancel, the session goes on with what it has.
    pub fn run(
        &mut self,
        request: &Request,
        until: StageName,
        control: &Control,
    ) -> Result<Stages, PipelineError> {
        control.check()?;
        request.check()?;
        let made = control.run(|| self.make(request, until, control));
        control.check()?;
        made
    }

    fn make(
        &mut self,
        request: &Request,
        until: StageName,
        control: &Control,
    ) -> Result<Stages, PipelineError> {
        let options = &request.options;
        let max_lean = options.fit.limits.max_lean;
        let mut work = Work { session: self, request, control };
        let wanted = work.wanted(max_lean)?;
        let mut stages = Stages {
            asked: request.clone(),
            used: DesignOptions { ratio: request.ratio(), ..options.clone() },
            revisions: Vec::new(),
            wanted,
            sized: None,
            toothed: None,
            analysed: None,
            proven: None,
            outfitted: None,
        };
        if until == StageName::Wanted {
            return Ok(stages);
        }
        if until <= StageName::Toothed {
            let bounds = Bounds::first(&stages.wanted, max_lean);
            let sized = work.sized(&stages.wanted, bounds, None)?;
            stages.use_of(&sized);
            if until == StageName::Toothed {
                stages.toothed = Some(work.toothed(&sized)?);
            }
            stages.sized = Some(sized);
            return Ok(stages);
        }
        let key = Settling::of(request, &stages.wanted, until >= StageName::Proven);
        let settled = match work.session.settled.find(&key) {
            Some(known) => known,
            None => {
                let made = Arc::new(settled(&mut work, until >= StageName::Proven)?);
                work.session.settled.keep(key, made.clone());
                made
            }
        };
        let analysed = settled.analysed.clone();
        let toothed = analysed.toothed.clone();
        let sized = toothed.sized.clone();
        stages.use_of(&sized);
        stages.revisions.clone_from(&settled.revisions);
        stages.wanted = sized.wanted.clone();
        // The watcher's last of each kind is what is delivered, whatever was tried in between.
        for stage in [
            Stage::Wanted(stages.wanted.clone()),
            Stage::Sized(sized.clone()),
            Stage::Toothed(toothed.clone()),
            Stage::Analysed(analysed.clone()),
        ] {
            work.told(&stage);
        }
        stages.sized = Some(sized);
        stages.toothed = Some(toothed);
        stages.analysed = Some(analysed);
        if let Some(proven) = &settled.proven {
            work.told(&Stage::Proven(proven.clone()));
            stages.proven = Some(proven.clone());
            if until == StageName::Outfitted {
                stages.outfitted = Some(work.outfitted(proven)?);
            }
        }
        Ok(stages)
    }
}

impl Settling {
    fn of(request: &Request, wanted: &Wanted, prove: bool) -> Self {
        let options = &request.options;
        let max_lean = options.fit.limits.max_lean;
        Self {
            wanted: wanted::Part::of(request, max_lean),
            sized: sized::Part::of(options, Bounds::first(wanted, max_lean), None),
            toothed: toothed::Part::of(options),
            limits: options.limits,
            proven: prove.then(|| proven::Part::of(options)),
            repair: options.repair,
            quick: options.quick,
        }
    }
}

impl Stages {
    fn use_of(&mut self, sized: &Sized) {
        self.used.teeth = ToothCount::Teeth(sized.teeth.driver);
        if !sized.bounds.exact {
            self.used.fit.limits = sized.bounds.limits(sized.teeth.driver, &self.used.fit.limits);
        }
    }
}

/// One request under way.
pub(super) struct Work<'a> {
    session: &'a mut Session,
    request: &'a Request,
    control: &'a Control,
}

impl<'a> Work<'a> {
    pub(super) fn request(&self) -> &'a Request {
        self.request
    }

    pub(super) fn options(&self) -> &'a DesignOptions {
        &self.request.options
    }

    fn told(&self, stage: &Stage) {
        if let Some(watcher) = &self.session.watcher {
            watcher(stage);
        }
    }

    pub(super) fn wanted(&mut self, max_lean: f64) -> Result<Arc<Wanted>, PipelineError> {
        let key = wanted::Part::of(self.request, max_lean);
        let control = self.control;
        let Session { wanted, fitter, .. } = &mut *self.session;
        let found = wanted.get(&key, || key.make(fitter, control))?;
        self.stands(found, Stage::Wanted)
    }

    /// `teeth`: the number of driver teeth in place of the one asked for.
    pub(super) fn sized(
        &mut self,
        wanted: &Arc<Wanted>,
        bounds: Bounds,
        teeth: Option<u32>,
    ) -> Result<Arc<Sized>, PipelineError> {
        let key = (Same(wanted.clone()), sized::Part::of(self.options(), bounds, teeth));
        let control = self.control;
        let found = self.session.sized.get(&key, || key.1.make(wanted, control))?;
        self.stands(found, Stage::Sized)
    }

    pub(super) fn toothed(&mut self, sized: &Arc<Sized>) -> Result<Arc<Toothed>, PipelineError> {
        let key = (Same(sized.clone()), toothed::Part::of(self.options()));
        let control = self.control;
        let found = self.session.toothed.get(&key, || key.1.make(sized, control))?;
        self.stands(found, Stage::Toothed)
    }

    /// `tried`: at few poses.
    pub(super) fn analysed(
        &mut self,
        toothed: &Arc<Toothed>,
        tried: bool,
    ) -> Result<Arc<Analysed>, PipelineError> {
        let options = self.options();
        let part = |tried| analysed::Part::of(options, toothed, tried);
        let key = (Same(toothed.clone()), part(tried));
        let known = (!tried)
            .then(|| self.session.analysed.find(&(Same(toothed.clone()), part(true))))
            .flatten();
        let control = self.control;
        let make = || key.1.make(toothed, known.as_deref(), control);
        let found = self.session.analysed.get(&key, make)?;
        self.stands(found, Stage::Analysed)
    }

    pub(super) fn proven(
        &mut self,
        analysed: &Arc<Analysed>,
    ) -> Result<Arc<Proven>, PipelineError> {
        let key = (Same(analysed.clone()), proven::Part::of(self.options()));
        let control = self.control;
        let found = self.session.proven.get(&key, || key.1.make(analysed, control))?;
        self.stands(found, Stage::Proven)
    }

    fn outfitted(&mut self, proven: &Arc<Proven>) -> Result<Arc<Outfitted>, PipelineError> {
        let key = (Same(proven.clone()), outfitted::Part::of(self.options()));
        let control = self.control;
        let found = self.session.outfitted.get(&key, || key.1.make(proven, control))?;
        self.stands(found, Stage::Outfitted)
    }

    /// Counts a stage that was made, and tells the watcher.
    fn stands<T>(
        &mut self,
        (made, is_new): (Arc<T>, bool),
        stage: fn(Arc<T>) -> Stage,
    ) -> Result<Arc<T>, PipelineError> {
        let stage = stage(made.clone());
        if is_new {
            *self.session.made.entry(stage.name()).or_default() += 1;
        }
        self.told(&stage);
        self.control.check()?;
        Ok(made)
    }
}

/// The very same result of a stage.
#[derive(Clone, Debug)]
struct Same<T>(Arc<T>);

impl<T> PartialEq for Same<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// The last results of one stage, by what they were made from.
struct Memo<K, V>(VecDeque<(K, Arc<V>)>);

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self(VecDeque::new())
    }
}

impl<K: PartialEq + Clone, V> Memo<K, V> {
    fn find(&mut self, key: &K) -> Option<Arc<V>> {
        let at = self.0.iter().position(|(k, _)| k == key)?;
        // What is used stays longest.
        let entry = self.0.remove(at)?;
        let value = entry.1.clone();
        self.0.push_back(entry);
        Some(value)
    }

    fn keep(&mut self, key: K, value: Arc<V>) {
        if self.0.len() == KEPT {
            self.0.pop_front();
        }
        self.0.push_back((key, value));
    }

    /// The result, and whether it had to be made.
    fn get<E>(
        &mut self,
        key: &K,
        make: impl FnOnce() -> Result<V, E>,
    ) -> Result<(Arc<V>, bool), E> {
        if let Some(known) = self.find(key) {
            return Ok((known, false));
        }
        let made = Arc::new(make()?);
        self.keep(key.clone(), made.clone());
        Ok((made, true))
    }
}

#[cfg(test)]
#[path = "session_tests.rs"]
mod tests;
