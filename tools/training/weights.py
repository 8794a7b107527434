"""Reads the weights of a network back from the file that export.py wrote. Needs Debian's python3-opencv."""
from pathlib import Path

import torch
from torch import Tensor, nn

from network import HandNetwork


def read_weights(network: HandNetwork, path: Path, images: Tensor) -> None:
    """Sets the weights of `network` to those of the file. The file's convolutions include the normalisation that follows
    them in training. It is separated from them again by its mean and variance on typical `images` [B, 2, H, W]."""
    import cv2

    if not path.is_file():
        raise SystemExit(f"{path} is missing (give a folder that train.py or configs/nets filled)")
    reader = cv2.dnn.readNetFromONNX(str(path))
    layers = [reader.getLayer(reader.getLayerId(name)).blobs for name in reader.getLayerNames()]
    stored = [[torch.from_numpy(blob.copy()) for blob in blobs] for blobs in layers if len(blobs)]
    modules = [module for module in network.modules() if isinstance(module, (nn.Conv2d, nn.Linear, nn.BatchNorm2d))]
    followers = dict(zip(modules, modules[1:] + [None]))
    linear = [module for module in modules if not isinstance(module, nn.BatchNorm2d)]
    if [blobs[0].shape for blobs in stored] != [module.weight.shape for module in linear]:
        raise SystemExit(f"{path} holds another network (give a folder that train.py or configs/nets filled)")

    # Store the weights, with normalisations that change nothing but add what the file's convolutions add.
    normalisations = []
    for module, (weight, bias) in zip(linear, stored):
        module.weight.data.copy_(weight)
        if module.bias is not None:
            module.bias.data.copy_(bias.flatten())
            continue
        follower = followers[module]
        follower.running_mean.zero_()
        follower.running_var.fill_(1 - follower.eps)
        follower.weight.data.fill_(1)
        follower.bias.data.copy_(bias.flatten())
        normalisations.append(follower)

    # Measure what reaches each normalisation, then let it normalise that and undo it.
    inputs: dict[nn.Module, Tensor] = {}
    hooks = [one.register_forward_pre_hook(lambda module, given: inputs.update({module: given[0]})) for one in normalisations]
    with torch.no_grad():
        network.eval()(images)
        for one, hook in zip(normalisations, hooks):
            hook.remove()
            mean, variance = inputs[one].mean((0, 2, 3)), inputs[one].var((0, 2, 3)).clamp_min(1e-4)
            one.bias.data += mean
            one.weight.data.copy_((variance + one.eps).sqrt())
            one.running_mean.copy_(mean)
            one.running_var.copy_(variance)
