"""Records of measurements, excitations, and fitting parameters to them."""

from .campaign.campaign import Campaign as Campaign
from .campaign.change import Change as Change
from .campaign.experiment import Experiment as Experiment
from .campaign.limits import Limit as Limit
from .campaign.limits import Limits as Limits
from .campaign.machine import Machine as Machine
from .campaign.machine import fmu_and_kind as fmu_and_kind
from .campaign.machine import read_network as read_network
from .campaign.priors import Prior as Prior
from .fitting.campaign_model import Accuracy as Accuracy
from .fitting.campaign_model import CampaignModel as CampaignModel
from .fitting.campaign_model import Prediction as Prediction
from .fitting.campaign_model import RecordModel as RecordModel
from .fitting.covariance import Rows as Rows
from .fitting.covariance import covariance as covariance
from .fitting.doubts import left_prior as left_prior
from .fitting.fit import fit as fit
from .fitting.intervals import EndedEarlyError as EndedEarlyError
from .fitting.intervals import Interval as Interval
from .fitting.intervals import profiled as profiled
from .fitting.least_squares import Ending as Ending
from .fitting.least_squares import Iterate as Iterate
from .fitting.least_squares import descent as descent
from .fitting.outcome import Fit as Fit
from .fitting.outcome import FitInterruptedError as FitInterruptedError
from .fitting.problem import Optimum as Optimum
from .fitting.steps import Steps as Steps
from .fitting.steps import cutoff_of as cutoff_of
from .fitting.suspects import likely_unit as likely_unit
from .fitting.suspects import suspects as suspects
from .fitting.suspects import told_of as told_of
from .fitting.uncertainty import tied as tied
from .fitting.uncertainty import uncertainty as uncertainty
from .records.excitation import Chirp as Chirp
from .records.excitation import Multisine as Multisine
from .records.excitation import Shuttle as Shuttle
from .records.excitation import SineDwells as SineDwells
from .records.excitation import sampled as sampled
from .records.filtered_noise import filtered_floors as filtered_floors
from .records.filtered_noise import floors_beside as floors_beside
from .records.filtered_noise import passed_band as passed_band
from .records.filters import Filter as Filter
from .records.heard import Heard as Heard
from .records.noise import NoiseFloor as NoiseFloor
from .records.noise import is_noise as is_noise
from .records.noise import residual_floor as residual_floor
from .records.noise import spectral_floor as spectral_floor
from .records.reading import read_record as read_record
from .records.record import Channel as Channel
from .records.record import Record as Record
from .records.uncovered_noise import uncovered_floors as uncovered_floors
from .records.weighing import Weighing as Weighing

__all__ = [
    "Campaign",
    "CampaignModel",
    "Channel",
    "Chirp",
    "Experiment",
    "Filter",
    "Fit",
    "FitInterruptedError",
    "Interval",
    "Multisine",
    "NoiseFloor",
    "Prediction",
    "Record",
    "Shuttle",
    "SineDwells",
    "fit",
    "read_record",
    "sampled",
]
